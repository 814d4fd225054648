#!/usr/bin/env python3
"""Makes docs/components.md, the reference of every component, from the declarations in the plugins.

    docs/make_components.py PLAZA [FILE]          writes FILE (docs/components.md beside this script)
    docs/make_components.py PLAZA --check [FILE]  fails when FILE is not what would be written

PLAZA is the command; only the plugins of its own tree are asked. Exits with 77 where a plugin was left out of the build,
since the reference would lack its components.
"""

import difflib
import json
import os
import pathlib
import subprocess
import sys

KINDS = {
    "source": ("Sources", "Give frames, detections or ground truth. The first one in a pipeline is its clock."),
    "modality": ("Modalities", "Measure images, and compare models with what they measured."),
    "shape": ("Shape models", "What a person's outline looks like. Parts of detectors."),
    "appearance": ("Appearance models", "What a person's surface looks like. Parts of describers."),
    "motion": ("Motion models", "How a person goes on. Parts of associators."),
    "detector": ("Detectors", "Find people in one frame."),
    "describer": ("Describers", "Add features or a heading to observations."),
    "affinity": ("Affinities", "How well two observations fit one person, by one cue. Parts of associators."),
    "associator": ("Associators", "Say who is who over time."),
    "evaluator": ("Evaluators", "Compare results with ground truth."),
    "sink": ("Sinks", "Write files while the stream runs."),
    "renderer": ("Renderers", "Draw final tracks and images after the stream has ended."),
}

INTRODUCTION = """\
# Components

Everything that a pipeline can name in `"use"`, made from the declarations in the plugins: `plaza list` and
`plaza show COMPONENT` tell the same of the plugins on your machine, third parties' included.

This file is written by `docs/make_components.py`; a test compares it with the declarations. To change it, change
a declaration and run `docs/make_components.py build/release/bin/plaza`.
"""


def ask(plaza, *arguments):
    environment = {k: v for k, v in os.environ.items() if k != "PLAZA_PLUGIN_PATH"}
    answer = subprocess.run([plaza, *arguments], env=environment, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise SystemExit(f"{plaza} {' '.join(arguments)} failed:\n{answer.stderr}")
    return answer.stdout


LEFT_OUT = 77


def refuse_what_lacks_a_plugin(plaza):
    missing = [line.strip() for line in ask(plaza, "plugins").splitlines() if "left out of this build" in line]
    if missing:
        print("\n".join(["not compared nor written:", *missing]), file=sys.stderr)
        raise SystemExit(LEFT_OUT)


def components_of(plaza):
    """Declarations by kind, in the order of `plaza list`."""
    kinds = {}
    kind = None
    for line in ask(plaza, "list").splitlines():
        if line.startswith("  "):
            declaration = json.loads(ask(plaza, "show", line.split()[0], "--json"))
            kinds.setdefault(kind, []).append(declaration)
        elif line:
            kind = line.strip()
    return kinds


def sentence(text):
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def table(head, rows):
    """Markdown without the columns that are empty in every row."""
    used = [i for i in range(len(head)) if i == 0 or any(row[i] for row in rows)]
    lines = ["| " + " | ".join(head[i] for i in used) + " |", "|" + "---|" * len(used)]
    lines += ["| " + " | ".join(cell(row[i]) for i in used) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def number(value):
    return f"{value:.15g}"


def innermost(parameter):
    return innermost(parameter["element"]) if "element" in parameter else parameter


def type_of(p):
    kind = p["type"]
    if kind == "choice":
        return "one of " + ", ".join(f"`{word}`" for word in p["choices"])
    if kind == "part":
        return f"one of the [{KINDS[p['kind']][0].lower()}](#{anchor_of_kind(p['kind'])})"
    if kind == "parts":
        return f"list of [{KINDS[p['kind']][0].lower()}](#{anchor_of_kind(p['kind'])})"
    if kind == "inputs":
        return f"list of inputs of {p['port']}"
    if kind == "list":
        return "list of " + type_of(p["element"])
    if kind == "map":
        return type_of(p["element"]) + " by name"
    return kind


def anchor_of_kind(kind):
    return KINDS[kind][0].lower().replace(" ", "-")


def range_of(p):
    limits = innermost(p)
    # the limits of a C++ integer say nothing about the parameter
    natural = {-2147483648.0, 2147483647.0, 4294967295.0, -9007199254740992.0, 9007199254740992.0}
    parts = [
        f"{sign} {number(limits[key])}"
        for key, sign in (("at_least", "≥"), ("above", ">"), ("at_most", "≤"), ("below", "<"))
        if key in limits and limits[key] not in natural
    ]
    least, most = p.get("min_items", 0), p.get("max_items")
    if most is not None and most == least:
        parts.append(f"{least} items")
    else:
        if least:
            parts.append(f"at least {least} items")
        if most is not None:
            parts.append(f"at most {most} items")
    return ", ".join(parts)


def default_of(p):
    if p["required"]:
        return "required"
    value = p["default"]
    if value is None:
        return "not set"
    if p["type"] == "part":
        return f"`{value['use']}`"
    return f"`{json.dumps(value, ensure_ascii=False)}`"


def parameter_rows(parameters, prefix=""):
    rows = []
    for p in parameters:
        rows.append([f"`{prefix}{p['name']}`", type_of(p), p["unit"], default_of(p), range_of(p), p["meaning"],
                     p["source"]])
        rows += parameter_rows(p.get("fields", []), f"{prefix}{p['name']}/")
    return rows


def section(component):
    name = component["name"]
    text = f"### {name}\n\n{sentence(component['summary'])}\n"
    if component["source"]:
        text += f"\nSource: {component['source']}\n"
    ports = [["reads" if port["required"] else "reads, optional", port["type"], port["meaning"]]
             for port in component["inputs"]]
    ports += [["gives", port["type"], port["meaning"]] for port in component["outputs"]]
    if ports:
        text += "\n" + table(["port", "type", "meaning"], ports)
    if component["parameters"]:
        text += "\n" + table(["parameter", "type", "unit", "default", "range", "meaning", "source"],
                             parameter_rows(component["parameters"]))
    if component["metrics"]:
        text += "\n" + table(
            ["metric", "unit", "better", "meaning"],
            [[f"`{m['section']}.{m['name']}`", m["unit"], "" if m["better"] == "neither" else m["better"], m["meaning"]]
             for m in component["metrics"]])
    if component["features"]:
        text += "\n" + table(
            ["feature", "", "meaning"],
            [[f"`{f['name']}`", "" if f["kept"] else "not kept between runs", f["meaning"]]
             for f in component["features"]])
    library = pathlib.Path(component["library"]).name.removesuffix(".so")
    return text + f"\nLibrary: `{library}`\n"


def page(kinds):
    unknown = sorted(set(kinds) - set(KINDS))
    if unknown:
        raise SystemExit(f"docs/make_components.py knows nothing of these kinds: {', '.join(unknown)}")
    parts = [INTRODUCTION]
    contents = [f"- [{KINDS[kind][0]}](#{anchor_of_kind(kind)}): "
                + ", ".join(f"[`{c['name']}`](#{c['name']})" for c in components)
                for kind, components in kinds.items()]
    parts.append("\n".join(contents) + "\n")
    for kind, components in kinds.items():
        title, meaning = KINDS[kind]
        parts.append(f"## {title}\n\n{meaning}\n")
        parts += [section(c) for c in components]
    return "\n".join(parts)


def main(arguments):
    check = "--check" in arguments
    arguments = [a for a in arguments if a != "--check"]
    if len(arguments) not in (1, 2):
        raise SystemExit(__doc__)
    file = pathlib.Path(arguments[1]) if len(arguments) == 2 else pathlib.Path(__file__).parent / "components.md"
    refuse_what_lacks_a_plugin(arguments[0])
    text = page(components_of(arguments[0]))
    if not check:
        file.write_text(text, encoding="utf-8")
        return
    committed = file.read_text(encoding="utf-8") if file.exists() else ""
    if committed == text:
        return
    difference = difflib.unified_diff(committed.splitlines(), text.splitlines(), str(file), "declarations", lineterm="")
    raise SystemExit("\n".join(difference) + f"\n\n{file} is out of date: run docs/make_components.py {arguments[0]}")


if __name__ == "__main__":
    main(sys.argv[1:])
