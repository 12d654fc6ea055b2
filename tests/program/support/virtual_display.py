# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""A virtual display (Xvfb) on a free number that the server itself picks, so that tests may start several at once.
As a program: virtual_display.py WIDTHxHEIGHT COMMAND ... runs a command on a display of its own and ends with its code."""
import os
import subprocess
import sys


class VirtualDisplay:
    def __init__(self, size):
        # -noreset: the server survives the moments in which it has no client.
        self.server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", f"{size[0]}x{size[1]}x24", "-noreset",
                                        "-nolisten", "tcp"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        number = self.server.stdout.readline().strip()
        if not number:
            self.close()
            raise RuntimeError(f"Xvfb ended with code {self.server.returncode}")
        self.name = ":" + number

    def close(self):
        self.server.terminate()
        self.server.wait()
        self.server.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def run_on_display(size, command):
    width, height = size.split("x")
    with VirtualDisplay((int(width), int(height))) as display:
        return subprocess.run(command, env=dict(os.environ, DISPLAY=display.name, WAYLAND_DISPLAY=""), check=False).returncode


if __name__ == "__main__":
    sys.exit(run_on_display(sys.argv[1], sys.argv[2:]))
