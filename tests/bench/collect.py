"""Runs the benchmark programs and collects their figures: collect.py BUILD OUT.json [FILTER...]

A figure is a user counter with a dot in its name ("eval.mot17_09.seconds") of any Google Benchmark
program below BUILD/bin. With filters, only figures whose name contains one of them are measured.
"""

import json
import pathlib
import platform
import subprocess
import sys
import tempfile


def cpu_name():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


def figures_of(program, filters):
    """Runs one program; benchmarks are named after the figures they give, so filters can skip them."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        command = [program, f"--benchmark_out={out.name}", "--benchmark_out_format=json"]
        if filters:
            listed = subprocess.run([program, "--benchmark_list_tests"], check=True, capture_output=True, text=True)
            if not any(f in name for name in listed.stdout.split() for f in filters):
                return {}
            command.append("--benchmark_filter=" + "|".join(f.replace(".", "[.]") for f in filters))
        subprocess.run(command, check=True)
        runs = json.load(open(out.name))["benchmarks"]
    figures = {}
    for run in runs:
        # with repetitions, the median is the figure
        if run.get("run_type") == "aggregate" and run.get("aggregate_name") != "median":
            continue
        for key, value in run.items():
            if "." in key and isinstance(value, (int, float)):
                figures[key] = value
        if run.get("error_occurred"):
            print(f"{run['name']}: {run.get('error_message')}", file=sys.stderr)
    return figures


def main():
    build, out, *filters = sys.argv[1:]
    figures = {}
    for program in sorted(pathlib.Path(build, "bin").glob("bench_*")):
        figures.update(figures_of(str(program), filters))
    machine = f"{cpu_name()}, {len(__import__('os').sched_getaffinity(0))} cores"
    pathlib.Path(out).parent.mkdir(parents=True, exist_ok=True)
    pathlib.Path(out).write_text(json.dumps({"machine": machine, "figures": figures}, indent=2) + "\n")
    width = max((len(name) for name in figures), default=0)
    for name in sorted(figures):
        print(f"{name:<{width}}  {figures[name]:.6g}")
    print(f"written to {out} ({machine})")
    if not figures:
        sys.exit("no benchmark gives a figure of that name")


main()
