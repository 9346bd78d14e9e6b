#!/usr/bin/env python3
"""How far the estimated position was from the true one, by what corrected it.

    build/release/bin/cairn experiment config/experiments/localisation.yaml --out out/localisation
    tests/bench/localisation_table.py out/localisation [FILE.png SEED VARIANT VARIANT]

With a file: the error over time of one seed in two variants, drawn by `cairn chart`.
"""
import json, pathlib, statistics, subprocess, sys, tempfile

CAIRN = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin/cairn"
AIM_MEDIAN_M, AIM_WORST_M = 0.10, 0.5


def reports_of(folder):
    runs = {}
    for file in pathlib.Path(folder).glob("*/*/seed_*/report.json"):
        runs.setdefault(file.parent.parent.name, {})[int(file.parent.name.removeprefix("seed_"))] = json.loads(
            file.read_text())
    return {variant: dict(sorted(of_seed.items())) for variant, of_seed in sorted(runs.items())}


def print_summary(runs):
    print("| variant | seeds | median of the medians m | medians of at most 0.10 m | worst m | never over 0.5 m | "
          "sigmas, median | driven m, median | touches |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    for variant, reports in runs.items():
        errors = [report["pose_error"] for report in reports.values()]
        medians = [error["median_m"] for error in errors]
        print(f"| {variant} | {len(errors)} | {statistics.median(medians):.3f} | "
              f"{sum(m <= AIM_MEDIAN_M for m in medians)} | {max(e['worst_m'] for e in errors):.2f} | "
              f"{sum(e['worst_m'] <= AIM_WORST_M for e in errors)} | "
              f"{statistics.median(e['sigmas_median'] for e in errors):.1f} | "
              f"{statistics.median(r['distance_m'] for r in reports.values()):.0f} | "
              f"{sum(r['collisions'] for r in reports.values())} |")


def print_seeds(variant, reports):
    print(f"\n{variant}:\n")
    print("| seed | median m | 95 % m | worst m | median deg | corrections | driven m |")
    print("|---:|---:|---:|---:|---:|---:|---:|")
    for seed, report in reports.items():
        e = report["pose_error"]
        print(f"| {seed} | {e['median_m']:.3f} | {e['p95_m']:.3f} | {e['worst_m']:.3f} | {e['median_deg']:.2f} | "
              f"{e['corrections']} | {report['distance_m']:.0f} |")


def draw(runs, file, seed, variants):
    """As a table that `cairn chart` draws, in the style of all charts."""
    errors = [{sample["time_s"]: sample["error_m"] for sample in runs[variant][seed]["pose_errors"]}
              for variant in variants]
    lines = [f"# {pathlib.Path(file).stem}\n", f"| time, s | {' | '.join(variants)} |", "|---:" * (len(variants) + 1) + "|"]
    for time_s in sorted(set().union(*errors)):
        lines.append(f"| {time_s} | {' | '.join(str(of_time.get(time_s, '')) for of_time in errors)} |")
    with tempfile.NamedTemporaryFile("w", suffix=".md") as table:
        table.write("\n".join(lines) + "\n")
        table.flush()
        subprocess.run([CAIRN, "chart", table.name, "--title", "Error of the position", "--y-label", "m", "--out",
                        pathlib.Path(file).parent], check=True)


def main(folder, *picture):
    runs = reports_of(folder)
    if picture:
        draw(runs, picture[0], int(picture[1]), picture[2:])
        return
    print_summary(runs)
    for variant, reports in runs.items():
        print_seeds(variant, reports)


main(*sys.argv[1:])
