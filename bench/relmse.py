#!/usr/bin/env python3
"""Compares a picture with a reference: relative mean square error over the pixels of a mask.

    bench/relmse.py picture.exr reference.exr [--mask mask.exr] [--trim 0.001]

Prints the mean linear RGB of both over the mask and relMSE = mean of (picture - reference)^2 / (reference^2 + 0.01),
where the worst 0.1 % of the values are left out: a single firefly would else decide the number. The mask is a picture
whose green is above 0.5 where a pixel counts (bench/cycles/render_scene.py makes one). Reads uncompressed EXR files of
32-bit floats in scan lines, which is what Blender writes when asked to; needs nothing but Python.
"""
import argparse
import array
import struct
import sys


def read_exr(path):
    """The file's width, height and channels: {"R": rows one after another, ...}. OpenEXR file layout, section 'Header'
    and 'Scan line blocks': attributes of name, type, size, value; then a table of block offsets; then per row its
    number, its size and all channels one after another in alphabetical order."""
    with open(path, "rb") as file:
        data = file.read()

    def text(at):
        end = data.index(b"\0", at)
        return data[at:end].decode(), end + 1

    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630:
        raise ValueError(f"{path}: not an EXR file")
    if version & 0xFFFFFF00 & ~0x400:  # bit 10 only allows long names
        raise ValueError(f"{path}: tiled, deep or multi-part EXR; expected plain scan lines")
    at, attributes = 8, {}
    while data[at]:
        name, at = text(at)
        _, at = text(at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    if attributes["compression"][0] != 0:
        raise ValueError(f"{path}: compressed EXR; write it without compression")
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1

    names, channels, i = [], attributes["channels"], 0
    while channels[i]:
        end = channels.index(b"\0", i)
        names.append(channels[i:end].decode())
        if struct.unpack_from("<i", channels, end + 1)[0] != 2:
            raise ValueError(f"{path}: channel {names[-1]} is not of 32-bit floats")
        i = end + 17
    planes = {name: array.array("f", bytes(4 * width * height)) for name in names}
    for offset in struct.unpack_from(f"<{height}Q", data, at + 1):
        (row,) = struct.unpack_from("<i", data, offset)
        for k, name in enumerate(names):
            start = offset + 8 + 4 * width * k
            values = array.array("f", data[start:start + 4 * width])
            if sys.byteorder == "big":
                values.byteswap()
            planes[name][(row - top) * width:(row - top + 1) * width] = values
    return width, height, planes


def compare(picture, reference, mask, trim):
    """Mean RGB of both and relMSE, over the pixels whose numbers are in `mask`."""
    errors, means = [], {"picture": [], "reference": []}
    for channel in "RGB":
        a, b = picture[channel], reference[channel]
        means["picture"].append(sum(a[i] for i in mask) / len(mask))
        means["reference"].append(sum(b[i] for i in mask) / len(mask))
        errors += [(a[i] - b[i]) ** 2 / (b[i] ** 2 + 0.01) for i in mask]
    errors.sort()
    kept = errors[:len(errors) - int(len(errors) * trim)]
    return means, sum(kept) / len(kept)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("picture")
    parser.add_argument("reference")
    parser.add_argument("--mask")
    parser.add_argument("--trim", type=float, default=0.001, help="part of the worst values left out")
    arguments = parser.parse_args()
    width, height, picture = read_exr(arguments.picture)
    size = (width, height)
    *reference_size, reference = read_exr(arguments.reference)
    mask = range(width * height)
    if arguments.mask:
        *mask_size, weights = read_exr(arguments.mask)
        mask = [i for i, green in enumerate(weights["G"]) if green > 0.5]
    for path, other in ((arguments.reference, reference_size), (arguments.mask, arguments.mask and mask_size)):
        if other and tuple(other) != size:
            raise ValueError(f"{path}: {other[0]}x{other[1]} pixels, but {arguments.picture} has {width}x{height}")
    if not mask:
        raise ValueError(f"{arguments.mask}: no pixel is above 0.5")
    means, error = compare(picture, reference, mask, arguments.trim)
    for name, rgb in means.items():
        print(f"{name + ' mean RGB':20} {rgb[0]:.4f} {rgb[1]:.4f} {rgb[2]:.4f}")
    print(f"{'relMSE':20} {error:.5f}   ({len(mask)} pixels)")


try:
    main()
except (OSError, ValueError) as problem:
    sys.exit(f"relmse.py: {problem}")
