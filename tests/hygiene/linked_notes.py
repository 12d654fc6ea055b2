# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails on a library that the program links, or a package of scripts/packages.txt that is a library, without a note in
third_party_notes. usage: linked_notes.py ROOT BUILD [SBOM]

With SBOM, writes an SPDX 2.3 document of what the program links to that file."""
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import source_text

# Of the compiler and the C library: part of every program on the system, under licences with an exception for that.
SYSTEM = {"gcc-12", "glibc"}


def notes(root):
    """{Debian package: (note, version, licence)}"""
    found = {}
    for path in sorted((Path(root) / "third_party_notes").glob("*.md")):
        text = path.read_text(encoding="utf-8")
        packages = re.search(r"^\| Version in Debian 12 \| (.*) \|$", text, re.M)
        licence = re.search(r"^\| Licence \| (.*) \|$", text, re.M)
        if not packages:
            continue
        for package, version in re.findall(r"([a-z0-9][a-z0-9+.-]+?)(?= [0-9]|,)(?: ([0-9][^ ,]*))?", packages[1]):
            found[package] = (path.name, version, licence[1] if licence else "")
    return found


def linked_libraries(build):
    """Paths of the libraries outside the project on the program's command line of the linker."""
    text = (Path(build) / "build.ninja").read_text(encoding="utf-8").replace("$\n", "")
    step = re.search(r"^build bin/gloam: .*?(?=^build )", text, re.M | re.S)
    if not step:
        return []
    words = re.search(r"^  LINK_LIBRARIES = (.*)$", step[0], re.M)[1].split()
    paths = [word for word in words if re.match(r"/.*\.(a|so[0-9.]*)$", word)]
    for word in words:
        if word.startswith("-l") and word not in ("-lm", "-ldl", "-lpthread", "-lrt"):
            paths.append(subprocess.run(["cc", f"-print-file-name=lib{word[2:]}.so"], capture_output=True, text=True,
                                        check=True).stdout.strip())
    return sorted(set(paths))


def debian(form, *arguments):
    run = subprocess.run(["dpkg-query", "-W", "-f", form, *arguments], capture_output=True, text=True)
    return run.stdout.split("\n") if run.returncode == 0 else []


def package_of(path):
    # Debian 12 moved /lib to /usr/lib; older packages are registered without /usr.
    real = Path(path).resolve().as_posix()
    for name in (real, path, real.removeprefix("/usr")):
        run = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True)
        if run.returncode == 0:
            return run.stdout.split(":")[0]
    return None


def source_of(package):
    lines = debian("${source:Package}\n", package)
    return lines[0] if lines else None


def sbom(linked, noted):
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
    created = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds))
    packages = []
    for package, (source, version) in sorted(linked.items()):
        licence = next((noted[name][2] for name in noted if source_of(name) == source), "NOASSERTION")
        packages.append({"name": package, "SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", package),
                         "versionInfo": version, "downloadLocation": "NOASSERTION", "licenseComments": licence,
                         "licenseConcluded": "NOASSERTION", "filesAnalyzed": False, "sourceInfo": f"Debian: {source}"})
    own = {"name": "gloam", "SPDXID": "SPDXRef-gloam", "downloadLocation": "NOASSERTION", "licenseConcluded": "MIT",
           "filesAnalyzed": False}
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": "gloam",
            "documentNamespace": "https://spdx.org/spdxdocs/gloam", "packages": [own] + packages,
            "creationInfo": {"created": created, "creators": ["Tool: linked_notes.py"]},
            "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES",
                               "relatedSpdxElement": "SPDXRef-gloam"}] +
                             [{"spdxElementId": "SPDXRef-gloam", "relationshipType": "DEPENDS_ON",
                               "relatedSpdxElement": p["SPDXID"]} for p in packages]}


def check(root, build, document=None):
    noted = notes(root)
    known = {source_of(name) for name in noted} | SYSTEM
    faults, linked = [], {}
    for path in linked_libraries(build):
        package = package_of(path)
        source = source_of(package) if package else None
        if source is None:
            faults.append(f"{path}: belongs to no Debian package")
        elif source not in known:
            faults.append(f"{path}: third_party_notes has no note about {source}")
        else:
            linked[package] = (source, debian("${Version}\n", package)[0])
    for package in (Path(root) / "scripts/packages.txt").read_text(encoding="utf-8").split():
        if package.startswith("lib") and package not in noted and source_of(package) not in known:
            faults.append(f"scripts/packages.txt: third_party_notes has no note about {package}")
    if document:
        Path(document).write_text(json.dumps(sbom(linked, noted), indent=1) + "\n", encoding="utf-8")
    return faults, len(linked)


if __name__ == "__main__":
    if not Path("/usr/bin/dpkg-query").exists():
        print("SKIPPED: this is no Debian system, so libraries are not matched with packages")
        sys.exit(77)
    if not (Path(sys.argv[2]) / "build.ninja").exists():
        print("SKIPPED: only builds with Ninja tell what the program links")
        sys.exit(77)
    sys.exit(source_text.report("linked_notes", *check(*sys.argv[1:4])))
