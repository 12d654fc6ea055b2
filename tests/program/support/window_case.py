# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""A virtual display for tests of `gloam play`: finds, resizes and photographs windows. Needs Xvfb and libX11."""
import ctypes
import ctypes.util
import os
import subprocess
import time

from program_case import CACHE, ProgramCase
from rgb_picture import Picture
from virtual_display import VirtualDisplay

Z_PIXMAP = 2
SELECTION_REQUEST, SELECTION_NOTIFY, CLIENT_MESSAGE = 30, 31, 33
ALL_PLANES = ctypes.c_ulong(-1)


class XImage(ctypes.Structure):
    _fields_ = [("width", ctypes.c_int), ("height", ctypes.c_int), ("xoffset", ctypes.c_int), ("format", ctypes.c_int),
                ("data", ctypes.POINTER(ctypes.c_ubyte)), ("byte_order", ctypes.c_int), ("bitmap_unit", ctypes.c_int),
                ("bitmap_bit_order", ctypes.c_int), ("bitmap_pad", ctypes.c_int), ("depth", ctypes.c_int),
                ("bytes_per_line", ctypes.c_int)]


class ClientMessage(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("window", ctypes.c_ulong), ("message_type", ctypes.c_ulong), ("format", ctypes.c_int),
                ("data", ctypes.c_long * 5), ("rest_of_union", ctypes.c_long * 24)]


class SelectionRequest(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("owner", ctypes.c_ulong), ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong),
                ("property", ctypes.c_ulong), ("time", ctypes.c_ulong)]


class Selection(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong), ("property", ctypes.c_ulong),
                ("time", ctypes.c_ulong), ("rest_of_union", ctypes.c_long * 24)]


class XEvent(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("rest_of_union", ctypes.c_long * 24)]


# Xlib's own handler ends the process. Calls that fail return nothing.
IGNORE_ERROR = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda *_: 0)
ANY_EVENT = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)(lambda *_: 1)


class Display:
    """The Xlib calls that find, resize and photograph windows."""

    def __init__(self, name):
        self.x11 = ctypes.CDLL(ctypes.util.find_library("X11") or "libX11.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.x11.XGetImage.restype = ctypes.POINTER(XImage)
        self.x11.XSetErrorHandler(IGNORE_ERROR)
        self.handle = ctypes.c_void_p(self.x11.XOpenDisplay(name.encode()))
        self.x11.XDefaultRootWindow.restype = ctypes.c_ulong
        self.x11.XInternAtom.restype = ctypes.c_ulong
        self.root = self.x11.XDefaultRootWindow(self.handle)

    def windows(self):
        root, parent, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.c_uint()
        children = ctypes.POINTER(ctypes.c_ulong)()
        self.x11.XQueryTree(self.handle, ctypes.c_ulong(self.root), ctypes.byref(root), ctypes.byref(parent),
                            ctypes.byref(children), ctypes.byref(count))
        return [children[i] for i in range(count.value)]

    def title(self, window):
        text = ctypes.c_char_p()
        self.x11.XFetchName(self.handle, ctypes.c_ulong(window), ctypes.byref(text))
        return (text.value or b"").decode()

    def find(self):
        """The program's window, or None."""
        for window in self.windows():
            if self.title(window).startswith("gloam"):
                return window
        return None

    def resize(self, window, width, height):
        self.x11.XResizeWindow(self.handle, ctypes.c_ulong(window), width, height)
        self.x11.XFlush(self.handle)

    def close(self, window):
        """Asks the program to close its window, as a window manager does."""
        protocols, delete = (self.x11.XInternAtom(self.handle, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW"))
        message = ClientMessage(type=CLIENT_MESSAGE, window=window, message_type=protocols, format=32)
        message.data[0] = delete
        self.x11.XSendEvent(self.handle, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(message))
        self.x11.XFlush(self.handle)

    def size(self, window):
        root, x, y = ctypes.c_ulong(), ctypes.c_int(), ctypes.c_int()
        width, height, border, depth = (ctypes.c_uint() for _ in range(4))
        self.x11.XGetGeometry(self.handle, ctypes.c_ulong(window), *map(ctypes.byref, (root, x, y, width, height, border, depth)))
        return width.value, height.value

    def photograph(self, window, taken=lambda: None):
        """What the window shows. taken() is called as soon as the program may change the window."""
        until, image = time.monotonic() + 60, None
        while not image and time.monotonic() < until:  # none while the window is not shown yet, or changes its size
            width, height = self.size(window)
            image = self.x11.XGetImage(self.handle, ctypes.c_ulong(window), 0, 0, width, height, ALL_PLANES, Z_PIXMAP)
        image = image.contents
        raw = ctypes.string_at(image.data, image.bytes_per_line * height)
        taken()
        rgb = bytearray(3 * width * height)
        for y in range(height):
            row = raw[y * image.bytes_per_line:y * image.bytes_per_line + 4 * width]
            for channel in range(3):
                rgb[3 * width * y + channel:3 * width * (y + 1):3] = row[2 - channel::4]
        return Picture(width, height, bytes(rgb))


class FileDrop:
    """A window from which a file is dropped onto another one, by the protocol XDND 5 as file managers do."""
    NAMES = ("XdndAware", "XdndEnter", "XdndPosition", "XdndStatus", "XdndDrop", "XdndFinished", "XdndActionCopy", "XdndSelection",
             "text/uri-list")

    def __init__(self, display, path):
        self.x11, self.handle, self.data = display.x11, display.handle, (path.as_uri() + "\r\n").encode()
        self.atoms = {name: self.x11.XInternAtom(self.handle, name.encode(), 0) for name in self.NAMES}
        self.x11.XCreateSimpleWindow.restype = ctypes.c_ulong
        self.window = self.x11.XCreateSimpleWindow(self.handle, ctypes.c_ulong(display.root), 0, 0, 1, 1, 0, ctypes.c_ulong(0),
                                                   ctypes.c_ulong(0))
        self.x11.XSetSelectionOwner(self.handle, ctypes.c_ulong(self.atoms["XdndSelection"]), ctypes.c_ulong(self.window),
                                    ctypes.c_ulong(0))

    def send(self, target, name, *words):
        message = ClientMessage(type=CLIENT_MESSAGE, window=target, message_type=self.atoms[name], format=32)
        for i, word in enumerate((self.window, *words)):
            message.data[i] = word
        self.x11.XSendEvent(self.handle, ctypes.c_ulong(target), 0, ctypes.c_long(0), ctypes.byref(message))
        self.x11.XFlush(self.handle)

    def answer(self):
        """Handles one event. Returns the name of an XDND message that it was, and its second word."""
        event = XEvent()
        if not self.x11.XCheckIfEvent(self.handle, ctypes.byref(event), ANY_EVENT, None):
            time.sleep(0.01)
            return None, 0
        if event.type == CLIENT_MESSAGE:
            message = ctypes.cast(ctypes.byref(event), ctypes.POINTER(ClientMessage)).contents
            names = [name for name, atom in self.atoms.items() if atom == message.message_type]
            return (names or [None])[0], message.data[1]
        if event.type == SELECTION_REQUEST:
            asked = ctypes.cast(ctypes.byref(event), ctypes.POINTER(SelectionRequest)).contents
            self.x11.XChangeProperty(self.handle, ctypes.c_ulong(asked.requestor), ctypes.c_ulong(asked.property),
                                     ctypes.c_ulong(asked.target), 8, 0, self.data, len(self.data))
            given = Selection(type=SELECTION_NOTIFY, requestor=asked.requestor, selection=asked.selection, target=asked.target,
                              property=asked.property, time=asked.time)
            self.x11.XSendEvent(self.handle, ctypes.c_ulong(asked.requestor), 0, ctypes.c_long(0), ctypes.byref(given))
            self.x11.XFlush(self.handle)
        return None, 0

    def onto(self, run, target, x, y):
        """Drops the file at a point of the screen. Returns when the target has taken it."""
        version, kind, copy = 5, self.atoms["text/uri-list"], self.atoms["XdndActionCopy"]
        answers = []

        def has_answered(name):
            answers.append(self.answer())
            return answers[-1][0] == name

        self.send(target, "XdndEnter", version << 24, kind, 0, 0)
        self.send(target, "XdndPosition", 0, x << 16 | y, 0, copy)
        run.wait_for("XdndStatus", lambda: has_answered("XdndStatus"))
        run.test.assertEqual(answers[-1][1] & 1, 1, "the window takes the file")
        self.send(target, "XdndDrop", 0, 0)
        run.wait_for("XdndFinished", lambda: has_answered("XdndFinished"))


class Running:
    """A program in a window, which an input script drives."""

    def __init__(self, test, program, folder, display):
        self.test, self.program, self.folder, self.display = test, program, folder, display

    def wait_for(self, what, happened):
        until = time.monotonic() + 240  # generous: only a hang may reach it, not a slow machine
        while time.monotonic() < until:
            if happened():
                return
            if self.program.poll() is not None:
                break
            time.sleep(0.01)
        self.program.kill()
        output, errors = self.program.communicate()
        self.test.fail(f"{what} did not happen: {output}{errors}")

    def wait_said(self, name):
        self.wait_for(f"'say {name}'", (self.folder / name).exists)

    def photograph_at(self, name):
        """Photographs the window at the events `say NAME` and `until NAME.seen` of the script."""
        self.wait_said(name)
        # The picture of the last frame before `say` may be on its way.
        time.sleep(0.3)
        return self.display.photograph(self.display.find(), (self.folder / (name + ".seen")).touch)

    def end(self):
        output, errors = self.program.communicate(timeout=240)
        self.test.assertEqual(self.program.returncode, 0, output + errors)
        return errors


class WindowCase(ProgramCase):
    def start(self, *arguments, script="", size=(800, 600), env=None):
        """Starts `gloam play` on a display of its own. script: the text of an input script."""
        virtual = VirtualDisplay(size)
        self.addCleanup(virtual.close)
        if script:
            (self.folder / "script.txt").write_text(script, encoding="utf-8")
            arguments = (*arguments, "--script", "script.txt")
        environment = dict(os.environ, DISPLAY=virtual.name, WAYLAND_DISPLAY="", XDG_CACHE_HOME=CACHE.name,
                           XDG_CONFIG_HOME=str(self.folder / "config"), **(env or {}))
        environment.pop("GLOAM_LOG", None)
        program = subprocess.Popen([self.program, "play", *map(str, arguments)], cwd=self.folder, env=environment,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: program.poll() is None and program.kill())
        return Running(self, program, self.folder, Display(virtual.name))
