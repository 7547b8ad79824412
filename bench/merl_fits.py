#!/usr/bin/env python3
"""Models fitted to the 95 MERL materials of the neural BRDFs (Sztrajman et al. 2021), and the parameters beside published ones.

    bench/merl_fits.py ../shared/data/brdf/merl/merl_nbrdf_weights.csv [--published ../shared/data/brdf/merl-fits]
        [--check pink-felt.nbrdf.binary] [--nacre build/release/nacre] [--keep FILE] [--only NAME ...] [--tables]

needs the Python package numpy. Each network is decoded into a MERL file in a temporary folder, which nacre fits by two
metrics. These are decoded, smooth data, a network's, and not the measurements. Results are kept in the file --keep, one
line of JSON for each material and metric, and a further run goes on with what is missing; --tables prints only."""
import argparse
import csv
import json
import pathlib
import re
import subprocess
import tempfile

import numpy as np

MODELS = ["ward variant=original", "ward variant=duer", "cook_torrance", "lafortune", "blinn_phong", "ggx"]
METRICS = ["cosine", "log"]
SCALE = np.array([1, 1.15, 1.66]) / 1500


def read_weights(file):
    with open(file, newline="") as text:
        rows = csv.reader(text)
        next(rows)
        return {row[0]: np.array(row[1:], np.float32) for row in rows}


def layers(weights):
    """Matrices and biases of the layers 6-21-21-3."""
    parts, at = [], 0
    for n, m in ((6, 21), (21, 21), (21, 3)):
        parts.append((weights[at:at + n * m].reshape(n, m), weights[at + n * m:at + n * m + m]))
        at += n * m + m
    return parts


def merl_nodes(offset=0.):
    """What a network takes at every node of MERL's grid, and whether both directions are above the horizon. Nodes stand
    at whole indices, as nacre reads them; with 0.5 in the middle of the cells, as the file of --check has them."""
    theta_h = np.radians(90 * ((np.arange(90) + offset) / 90) ** 2)[:, None, None]
    theta_d = np.radians(np.arange(90) + offset)[None, :, None]
    phi_d = np.radians(np.arange(180) + offset)[None, None, :]
    shape = (90, 90, 180)
    d = [np.sin(theta_d) * np.cos(phi_d), np.sin(theta_d) * np.sin(phi_d), np.cos(theta_d) + 0 * phi_d]
    h = [np.sin(theta_h), 0 * theta_h, np.cos(theta_h)]
    nodes = np.stack([np.broadcast_to(x, shape).ravel() for x in h + d], 1).astype(np.float32)
    # The difference vector turned by theta_h about y is the one direction, mirrored at the half vector the other.
    z = np.cos(theta_h) * d[2] - np.sin(theta_h) * d[0], np.cos(theta_h) * d[2] + np.sin(theta_h) * d[0]
    return nodes, ((z[0] >= 0) & (z[1] >= 0)).ravel()


def decode(weights, nodes, above):
    """BRDF in sr^-1 at the nodes, three rows; -1 where there is none."""
    x = nodes
    for i, (matrix, bias) in enumerate(layers(weights)):
        x = x @ matrix + bias
        if i < 2:
            np.maximum(x, 0, out=x)
    f = np.maximum(np.expm1(x), 0).T.astype(float)
    f[:, ~above] = -1
    return f


def write_merl(file, brdf):
    with open(file, "wb") as out:
        np.array([90, 90, 180], "<i4").tofile(out)
        for c in range(3):
            np.where(brdf[c] < 0, -1, brdf[c] / SCALE[c]).astype("<f8").tofile(out)


def check(file, brdf):
    stored = np.fromfile(file, "<f8", offset=12).reshape(3, -1)
    worst = 0
    for c in range(3):
        there = stored[c] >= 0
        if (there != (brdf[c] >= 0)).any():
            print("check: other nodes are missing:", (there != (brdf[c] >= 0)).sum())
            there &= brdf[c] >= 0
        a, b = stored[c][there] * SCALE[c], brdf[c][there]
        worst = max(worst, np.max(np.abs(a - b) / np.maximum(a, 1e-3)))
    print(f"check: {file}: values differ by at most {worst:.1e}")


def fit(nacre, file, metric):
    text = subprocess.run(["nice", nacre, "fit", str(file), "--model", ",".join(MODELS), "--metric", metric, "--quiet",
                           "--json"], check=True, capture_output=True, text=True).stdout
    return json.loads(text)


def fit_all(args):
    weights = read_weights(args.weights)
    names = args.only or list(weights)
    names = [name for start in range(4) for name in names[start::4]]  # what is there after a while is spread evenly
    done = {(r["target"], r["metric"]) for r in results(args.keep)}
    nodes, above = merl_nodes()
    if args.check:
        check(args.check, decode(weights["pink-felt"], *merl_nodes(0.5)))
    with tempfile.TemporaryDirectory() as folder, open(args.keep, "a") as kept:
        for name in names:
            left = [m for m in METRICS if (name + ".binary", m) not in done]
            if not left:
                continue
            file = pathlib.Path(folder, name + ".binary")
            write_merl(file, decode(weights[name], nodes, above))
            for metric in left:
                kept.write(json.dumps(fit(args.nacre, file, metric)) + "\n")
                kept.flush()
            file.unlink()


def results(file):
    if not pathlib.Path(file).exists():
        return []
    return [json.loads(line) for line in pathlib.Path(file).read_text().splitlines()]


def label(model):
    return (model["model"] + " " + model["given"]).strip()


def print_errors(all_results):
    print("\nErrors on held-out pairs, per cent of a black surface's; how often a model is the best of its metric")
    print(f"{'metric':8} {'model':24} {'quartile':>9} {'median':>9} {'quartile':>9} {'worst':>9} {'fit':>9} {'best of':>8}"
          f" {'seconds':>8}")
    for metric in METRICS:
        fits = [r for r in all_results if r["metric"] == metric]
        best = [label(min((m for m in r["models"] if "errors" in m), key=lambda m: m["errors"]["held_out"][metric]))
                for r in fits]
        for name in MODELS:
            models = [m for r in fits for m in r["models"] if label(m) == name and "errors" in m]
            held_out = [100 * m["errors"]["held_out"][metric] for m in models]
            own = [100 * m["errors"]["fit"][metric] for m in models]
            low, middle, high = np.percentile(held_out, [25, 50, 75])
            print(f"{metric:8} {name:24} {low:9.2f} {middle:9.2f} {high:9.2f} {max(held_out):9.2f} {np.median(own):9.2f}"
                  f" {best.count(name):8} {np.median([m['seconds'] for m in models]):8.2f}")
        print(f"{metric:8} {len(fits)} materials")


def published(file):
    """Of each material the numbers by name; diffuse albedo as kd."""
    table = {}
    for line in file.read_text().splitlines():
        found = re.match(r"(\S+) = Aggregate\(Lambertian\(albedo = (\[[^]]*\])\), \w+\((.*)\)\)", line)
        if found:
            lobe = {k: json.loads(v) for k, v in re.findall(r"(\w+) = (\[[^]]*\]|[-+.\deE]+)", found[3])}
            table[found[1]] = {"kd": json.loads(found[2])} | lobe
    return table


def bands(value):
    return np.array(value if isinstance(value, list) else [value] * 3, float)


def fresnel0(n):
    return ((bands(n) - 1) / (bands(n) + 1)) ** 2


# Table, our model, metric; then of each parameter: name, theirs, ours.
COMPARED = [
    ("ngan_ward", "ward variant=original", "cosine",
     [("roughness", lambda p: p["roughness"], lambda q: q["alpha"]), ("ks", lambda p: p["albedo"], lambda q: q["ks"])]),
    ("ngan_wardduer", "ward variant=duer", "cosine",
     [("roughness", lambda p: p["roughness"], lambda q: q["alpha"]), ("ks", lambda p: p["albedo"], lambda q: q["ks"])]),
    ("ngan_blinnphong", "blinn_phong", "cosine",
     [("exponent", lambda p: p["sharpness"], lambda q: q["n"])]),
    ("ngan_lafortune", "lafortune", "cosine",
     [("exponent", lambda p: p["sharpness"], lambda q: q["n"])]),
    ("ngan_cooktorrance", "cook_torrance", "cosine",
     [("roughness", lambda p: p["roughness"], lambda q: q["m"]),
      ("ks F(0)", lambda p: bands(p["albedo"]) * p["eta"], lambda q: bands(q["ks"]) * fresnel0(q["n"]))]),
    ("low_cooktorrance_E1", "cook_torrance", "cosine",
     [("roughness", lambda p: p["roughness"], lambda q: q["m"]),
      ("ks F(0)", lambda p: bands(p["albedo"]) * fresnel0(p["eta"]), lambda q: bands(q["ks"]) * fresnel0(q["n"]))]),
    ("low_cooktorrance_E2", "cook_torrance", "log",
     [("roughness", lambda p: p["roughness"], lambda q: q["m"]),
      ("ks F(0)", lambda p: bands(p["albedo"]) * fresnel0(p["eta"]), lambda q: bands(q["ks"]) * fresnel0(q["n"]))]),
]


def rank(x):
    """Equal numbers have their mean rank."""
    order = np.argsort(np.argsort(x, kind="stable"), kind="stable").astype(float)
    return np.array([order[x == v].mean() for v in x])


def print_correlations(all_results, folder):
    print("\nOurs beside published ones: correlation of logarithms, of ranks; ours over theirs, median, by band")
    print(f"{'table':22} {'model':22} {'parameter':10} {'n':>4} {'log':>6} {'rank':>6}   ratio in red, green, blue")
    for name, model, metric, parameters in COMPARED:
        table = published(pathlib.Path(folder, name + ".fit"))
        pairs = [(table[material], m["terms"][0]["parameters"]) for r in all_results if r["metric"] == metric
                 for m in r["models"] if label(m) == model and "terms" in m
                 and (material := r["target"].removesuffix(".binary")) in table]
        for what, theirs, ours in [("kd", lambda p: p["kd"], lambda q: q["kd"])] + parameters:
            a, b = np.array([bands(theirs(p)) for p, _ in pairs]), np.array([bands(ours(q)) for _, q in pairs])
            good = (a > 1e-9) & (b > 1e-9)
            x, y = np.log(a[good]), np.log(b[good])
            if (a[:, 0] == a[:, 2]).all() and (b[:, 0] == b[:, 2]).all():  # one number for all bands
                x, y = np.log(a[good.all(1), 0]), np.log(b[good.all(1), 0])
            ratio = [np.median(b[good[:, c], c] / a[good[:, c], c]) for c in range(3)]
            print(f"{name:22} {model:22} {what:10} {len(pairs):4} {np.corrcoef(x, y)[0, 1]:6.3f}"
                  f" {np.corrcoef(rank(x), rank(y))[0, 1]:6.3f}   {ratio[0]:.3f} {ratio[1]:.3f} {ratio[2]:.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("weights")
    parser.add_argument("--published")
    parser.add_argument("--check")
    parser.add_argument("--nacre", default="build/release/nacre")
    parser.add_argument("--keep", default="merl_fits.jsonl")
    parser.add_argument("--only", nargs="+")
    parser.add_argument("--tables", action="store_true")
    args = parser.parse_args()
    if not args.tables:
        fit_all(args)
    found = results(args.keep)
    print_errors(found)
    if args.published:
        print_correlations(found, args.published)


if __name__ == "__main__":
    main()
