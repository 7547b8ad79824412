#!/usr/bin/env python3
"""How far nacre and Mitsuba 3 are from isotropic RGL files evaluated in double precision, at random pairs of directions.

    PYTHONPATH=... bench/measured_in_double.py [--pairs 10000] [--seed 1] [--nacre build/release/nacre] FILE_rgb.bsdf ...

needs the Python packages mitsuba and numpy. Values: differences over the larger of the value and 1 % of the largest
one; the largest, and the 99.9th percentile. `a digit` is what half a unit in the last place of the half vector's azimuth,
as a float, does to the value of the pair at which both programs differ most."""
import argparse
import csv
import math
import os
import random
import struct
import subprocess
import tempfile

import mitsuba as mi
import numpy as np

from measured_against_mitsuba import direction


def tensors(path):
    data = open(path, "rb").read()
    (count,), at, found = struct.unpack("<I", data[14:18]), 18, {}
    for _ in range(count):
        (length,) = struct.unpack("<H", data[at:at + 2])
        name, at = data[at + 2:at + 2 + length].decode(), at + 2 + length
        dimensions, kind, offset = struct.unpack("<HBQ", data[at:at + 11])
        shape = struct.unpack(f"<{dimensions}Q", data[at + 11:at + 11 + 8 * dimensions])
        at += 11 + 8 * dimensions
        if kind == 10:
            found[name] = np.frombuffer(data, np.float32, math.prod(shape), offset).reshape(shape).astype(float)
    return found


def patch(x, nodes):
    at = min(max(x, 0), 1) * (nodes - 1)
    first = min(int(at), nodes - 2)
    return first, at - first


def bilinear(table, x, y):
    (i, a), (j, b) = patch(x, table.shape[-1]), patch(y, table.shape[-2])
    rows = (1 - a) * table[..., j:j + 2, i] + a * table[..., j:j + 2, i + 1]
    return (1 - b) * rows[..., 0] + b * rows[..., 1]


def up_to(values):
    return np.concatenate([[0], np.cumsum(0.5 * (values[1:] + values[:-1]))])


class InDouble:
    """f cos of J. Dupuy, W. Jakob 2018, as rgl_brdf.h says it."""

    def __init__(self, path):
        self.t = tensors(path)
        if "rgb" not in self.t or len(self.t["phi_i"]) > 1:
            raise SystemExit(f"{path}: not isotropic, or without colours")
        table = self.t["vndf"][0]
        patches = 0.25 * (table[:, 1:, 1:] + table[:, :-1, 1:] + table[:, 1:, :-1] + table[:, :-1, :-1])
        self.vndf = table / patches.sum((1, 2))[:, None, None]

    def value(self, light, viewer, off=0.0):
        wi, wo = (np.float32(w).astype(float) for w in (light, viewer))
        h = (wi + wo) / np.linalg.norm(wi + wo)
        theta, theta_h = (math.atan2(math.hypot(w[0], w[1]), w[2]) for w in (wo, h))
        phi, phi_h = (math.atan2(w[1], w[0]) for w in (wo, h))

        def square_x(angle):
            return math.sqrt(angle * 2 / math.pi)

        def square_y(angle):
            return (angle + math.pi) / (2 * math.pi) % 1

        x, y = square_x(theta_h), square_y(phi_h - phi + off)
        nodes = self.t["theta_i"]
        k = min(max(int(np.searchsorted(nodes, theta, "right")) - 1, 0), len(nodes) - 2)
        part = min(max((theta - nodes[k]) / (nodes[k + 1] - nodes[k]), 0), 1)
        table = (1 - part) * self.vndf[k] + part * self.vndf[k + 1]
        (i, a), (j, b) = patch(x, table.shape[1]), patch(y, table.shape[0])
        row = (1 - b) * table[j] + b * table[j + 1]
        sums = up_to(row)
        u = (sums[i] + a * (row[i] + 0.5 * a * (row[i + 1] - row[i]))) / sums[-1]
        rows = np.array([up_to(r)[-1] for r in table])
        v = up_to(rows)[j] + b * (rows[j] + 0.5 * b * (rows[j + 1] - rows[j]))
        spectra = self.t["rgb"][0]
        stored = (1 - part) * bilinear(spectra[k], u, v) + part * bilinear(spectra[k + 1], u, v)
        jacobian = bilinear(self.t["ndf"], x, y) / (4 * bilinear(self.t["sigma"], square_x(theta), square_y(phi)))
        return np.maximum(stored * jacobian, 0)


def at_pairs(nacre, path, pairs):
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "pairs.csv")
        with open(table, "w") as f:
            for light, viewer in pairs:
                f.write(",".join(f"{x:.9g}" for x in light + viewer) + "\n")
        text = subprocess.run([nacre, "data", "eval", path, "--pairs", table, "--rendered"],
                              check=True, capture_output=True, text=True).stdout
    ours = np.array([[float(x) for x in row[:3]] for row in list(csv.reader(text.splitlines()))[1:]])
    bsdf, context, si = mi.load_dict({"type": "measured", "filename": path}), mi.BSDFContext(), mi.SurfaceInteraction3f()
    theirs = []
    for light, viewer in pairs:
        si.wi = mi.Vector3f(*viewer)
        theirs.append([max(float(v), 0) for v in bsdf.eval(context, si, mi.Vector3f(*light))])
    return ours, np.array(theirs)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="+")
    parser.add_argument("--pairs", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--nacre", default="build/release/nacre")
    o = parser.parse_args()
    mi.set_variant("scalar_rgb")
    rng = random.Random(o.seed)
    pairs = [(direction(rng), direction(rng)) for _ in range(o.pairs)]
    print(f"{'largest, 99.9 %':32} {'both apart':>10} {'nacre from double':>18} {'Mitsuba from double':>20} {'a digit':>8}")
    for path in o.files:
        exact = InDouble(path)
        double = np.array([exact.value(*pair) for pair in pairs])
        floor = np.maximum(double, 0.01 * double.max(0))
        ours, theirs = at_pairs(o.nacre, path, pairs)

        def apart(a, b):
            return (np.abs(a - b) / floor).max(1)

        worst = int(np.argmax(apart(ours, theirs)))
        digit = np.abs(exact.value(*pairs[worst], 2 ** -22) - double[worst]) / floor[worst]
        ours_off, theirs_off = apart(ours, double), apart(theirs, double)
        print(f"{os.path.basename(path):32} {apart(ours, theirs).max():10.1e}"
              f" {ours_off.max():10.1e} {np.quantile(ours_off, 0.999):7.1e}"
              f" {theirs_off.max():12.1e} {np.quantile(theirs_off, 0.999):7.1e} {digit.max():8.1e}", flush=True)


if __name__ == "__main__":
    main()
