#!/usr/bin/env python3
"""tidy.py BUILD SOURCE...: clang-tidy over the sources that it has not yet passed as they are.

A source is passed over when nothing that its result depends on has changed since it was found clean: its text, every
header that it includes (the system's as well), its command, .clang-tidy and clang-tidy itself. What is known of a
source stands in BUILD/tidy/, one file per source; remove the folder to check everything again.
"""
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache


@lru_cache(maxsize=None)
def digest(path):
    """Hash of a file's content; of nothing where it is missing, which is a change, too."""
    try:
        return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
    except OSError:
        return ""


def commands(build):
    """Source -> (folder, arguments without output), from compile_commands.json."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        arguments = shlex.split(entry["command"])
        while os.path.basename(arguments[0]) not in ("c++", "g++", "clang++"):
            arguments.pop(0)  # the launcher and its settings
        at = arguments.index("-o")
        found.setdefault(entry["file"], (entry["directory"], arguments[:at] + arguments[at + 2:]))
    return found


def dependencies(folder, arguments):
    """All files that the source is made of, as the preprocessor names them; none when it fails."""
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


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, text=True, check=True).stdout
    known_commands = commands(build)
    stamps = build / "tidy"
    stamps.mkdir(exist_ok=True)
    pending = []
    for source in sys.argv[2:]:
        path = os.path.abspath(source)
        # a source of which the build knows no command (its library is missing here): clang-tidy guesses one
        folder, arguments = known_commands.get(path, (os.getcwd(), []))
        base = [version, digest(".clang-tidy"), folder, arguments]
        stamp = stamps / (source.replace("/", "+") + ".json")
        if not is_known(stamp, base):
            pending.append((source, folder, arguments, base, stamp))
    print(f"clang-tidy: {len(pending)} of {len(sys.argv) - 2} sources to check", file=sys.stderr)

    def check(job):
        source, folder, arguments, base, stamp = job
        # before the check: a file that is edited meanwhile must count as changed
        files = {path: digest(path) for path in dependencies(folder, arguments)} if arguments else {}
        stamp.unlink(missing_ok=True)
        run = subprocess.run(["clang-tidy", "-p", str(build), "--quiet", source], capture_output=True, text=True)
        if run.returncode == 0 and not run.stdout.strip() and files:
            stamp.write_text(json.dumps({"base": base, "files": files}))
        if run.returncode or run.stdout.strip():
            print(run.stdout + run.stderr, flush=True)
        return run.returncode == 0

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return 0 if all(list(pool.map(check, pending))) else 1


if __name__ == "__main__":
    sys.exit(main())
