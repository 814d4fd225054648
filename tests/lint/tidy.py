#!/usr/bin/env python3
"""tidy.py BUILD SOURCE...: clang-tidy over the sources that it has not yet passed as they are.

It checks units: what the build compiles at once, eight sources of a target or one. Most of the time goes into the
syntax trees of the standard library, Eigen, OpenCV and json, and those of a unit are walked once. A unit is checked as
one text made of its sources' texts, since to clang a file that is included is a header, which its static analyzer
leaves out; findings are told by the sources' own lines. The analyzer works in its shallow mode (each function with the
small ones that it calls): the deep one takes four times as long, more than all other checks together.

A unit is passed over when nothing that its result depends on has changed since it was found clean: its sources, every
header that they include (the system's as well), its command, .clang-tidy, clang-tidy and this script. What is known of
a unit stands in BUILD/tidy/, two files per unit; remove the folder to check everything again.
"""
import bisect
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache

SHALLOW = [f"--extra-arg={word}" for word in ("-Xclang", "-analyzer-config", "-Xclang", "mode=shallow")]


@lru_cache(maxsize=None)
def digest(path):
    """Hash of a file's content; of nothing where it is missing, which is a change, too."""
    try:
        return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
    except OSError:
        return ""


def commands(build):
    """Unit -> (folder, arguments without output), from compile_commands.json."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        arguments = shlex.split(entry["command"])
        while os.path.basename(arguments[0]) not in ("c++", "g++", "clang++"):
            arguments.pop(0)  # the launcher and its settings
        at = arguments.index("-o")
        found.setdefault(entry["file"], (entry["directory"], arguments[:at] + arguments[at + 2:]))
    return found


def sources_of(unit):
    """What the build compiles as this unit: the sources that it includes when CMake wrote it, itself otherwise."""
    if re.fullmatch(r"unity_\d+_cxx\.cxx", os.path.basename(unit)):
        return re.findall(r'^#include "(.+)"$', pathlib.Path(unit).read_text(), re.MULTILINE)
    return [unit]


def dependencies(folder, arguments):
    """All files that the unit is made of, as the preprocessor names them; none when it fails."""
    run = subprocess.run([*arguments, "-M", "-MT", "source"], cwd=folder, capture_output=True, text=True)
    if run.returncode:
        return []
    names = shlex.split(run.stdout.replace("\\\n", " "))[1:]
    return sorted({os.path.normpath(os.path.join(folder, name)) for name in names})


def is_known(stamp, base):
    try:
        known = json.loads(stamp.read_text())
    except (OSError, ValueError):
        return False
    return known["base"] == base and all(digest(path) == text for path, text in known["files"].items())


def joined(sources, path):
    """Writes the sources' texts into one; returns a function that gives messages about it the sources' lines."""
    starts, lines = [], 0
    with open(path, "w") as text:
        for source in sources:
            starts.append(lines)
            own = pathlib.Path(source).read_text()
            text.write(own)
            lines += own.count("\n")

    def told(match):
        line = int(match[1])
        at = bisect.bisect_left(starts, line) - 1
        return f"{os.path.relpath(sources[at])}:{line - starts[at]}:"

    return lambda messages: re.sub(re.escape(str(path)) + r":(\d+):", told, messages)


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, text=True, check=True).stdout
    known_commands = commands(build)
    unit_of = {source: unit for unit in reversed(known_commands) for source in sources_of(unit)}
    wanted = [os.path.abspath(source) for source in sys.argv[2:]]
    # a source of which the build knows no command (its library is missing here) is a unit of which clang-tidy guesses it
    units = sorted({unit_of.get(source, source) for source in wanted})
    stamps = build / "tidy"
    stamps.mkdir(exist_ok=True)
    pending = []
    for unit in units:
        folder, arguments = known_commands.get(unit, (os.getcwd(), []))
        base = [version, digest(".clang-tidy"), digest(__file__), folder, arguments]
        stamp = stamps / (os.path.relpath(unit).replace("/", "+") + ".json")
        if not is_known(stamp, base):
            pending.append((unit, folder, arguments, base, stamp))
    print(f"clang-tidy: {len(pending)} of {len(units)} units to check, of {len(wanted)} sources", file=sys.stderr)

    def check(job):
        unit, folder, arguments, base, stamp = job
        # before the check: a file that is edited meanwhile must count as changed
        files = {path: digest(path) for path in dependencies(folder, arguments)} if arguments else {}
        stamp.unlink(missing_ok=True)
        text = stamp.with_suffix(".cc")
        sources = sources_of(unit)
        in_sources = joined(sources, text)
        beside = [f"-iquote{place}" for place in sorted({os.path.dirname(os.path.abspath(source)) for source in sources})]
        run = subprocess.run(["clang-tidy", "--quiet", *SHALLOW, text, "--",
                              *[word for word in arguments[1:] if word not in ("-c", unit)], *beside],
                             cwd=folder, capture_output=True, text=True)
        clean = run.returncode == 0 and not run.stdout.strip()
        if clean and files:
            stamp.write_text(json.dumps({"base": base, "files": files}))
        if not clean:
            print(in_sources(run.stdout + run.stderr), flush=True)
        return clean

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return 0 if all(list(pool.map(check, pending))) else 1


if __name__ == "__main__":
    sys.exit(main())
