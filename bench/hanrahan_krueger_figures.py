#!/usr/bin/env python3
"""Lobes of Hanrahan and Krueger 1993 over asymmetry, thickness and incidence, by `nacre slab --lobe` and gnuplot.

    bench/hanrahan_krueger_figures.py [folder]     (docs/pictures/lobes)

Writes lobes_g.svg: for g = -0.3, 0 and 0.6 the lobes of layers of optical thickness 0.5, 1 and 2, light from 40 degrees,
equal indices; and lobes_incidence.svg: light from 10, 40 and 65 degrees on a layer of index 1.33, g 0, thickness 1, as
radiance over incident radiance, Fresnel's factors in it. Albedo 1 everywhere.
"""
import csv
import io
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
NACRE = ROOT / "build" / "release" / "nacre"
DEGREES = "set angles degrees\nset zeroaxis\nset size ratio -1\nset key outside bottom center horizontal\nset tics font ',9'\nset xtics rotate by -60\n"


def lobe(layer, *options):
    """Rows of (angle, value for each incidence)."""
    out = subprocess.run([NACRE, "slab", "--layer", layer, "--lobe", *options], capture_output=True, text=True, check=True)
    return [[float(x) for x in row] for row in list(csv.reader(io.StringIO(out.stdout)))[1:]]


def block(name, curves):
    lines = [f"${name} << EOD"]
    for rows in zip(*curves):
        lines.append(" ".join([str(rows[0][0])] + [str(x) for r in rows for x in r[1:]]))
    return "\n".join(lines + ["EOD\n"])


def curve(name, column, title):
    return f"${name} using (${column}*sin($1)):(${column}*cos($1)) with lines lw 1.5 title '{title}'"


def plot(file, size, body):
    script = f"set terminal svg size {size} font 'sans,11'\nset output '{file}'\n{DEGREES}{body}"
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "pictures" / "lobes"
    folder.mkdir(parents=True, exist_ok=True)
    thicknesses = (0.5, 1, 2)
    body = ""
    for i, g in enumerate((-0.3, 0, 0.6)):
        body += block(f"g{i}", [lobe(f"tau={t} albedo=1 g={g}", "--angle", "40") for t in thicknesses])
    body += "set multiplot layout 1,3\n"
    for i, g in enumerate((-0.3, 0, 0.6)):
        body += f"set title 'g = {g}'\nplot " + ", ".join(
            curve(f"g{i}", k + 2, f"tau = {t}") for k, t in enumerate(thicknesses)) + "\n"
    plot(folder / "lobes_g.svg", "960,420", body + "unset multiplot\n")

    body = block("n", [lobe("tau=1 albedo=1 g=0 eta=1.33")])
    body += "set title 'g = 0, tau = 1, n = 1.33: radiance over incident radiance'\nplot " + ", ".join(
        curve("n", k + 2, f"{a} degrees") for k, a in enumerate((10, 40, 65)))
    plot(folder / "lobes_incidence.svg", "480,420", body + "\n")


if __name__ == "__main__":
    main()
