#!/usr/bin/env python3
"""Compares a picture with a reference: relative mean square error over the pixels of a mask.

    bench/relmse.py picture.exr reference.exr [--mask mask.exr] [--trim 0.001]

Prints the mean linear RGB of both over the mask and relMSE = mean of (picture - reference)^2 / (reference^2 + 0.01),
where the worst 0.1 % of the values are left out: a single firefly would else decide the number. The mask is a picture
whose green is above 0.5 where a pixel counts (bench/cycles/render_scene.py makes one). Reads EXR files in scan lines,
uncompressed or with ZIP, of 16- or 32-bit floats; needs nothing but Python.
"""
import argparse
import itertools
import struct
import sys
import zlib

FORMATS = {1: "e", 2: "f"}  # OpenEXR's numbers for half and float, and struct's letters
ROWS_PER_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP


def inflate(block, size):
    """Undoes OpenEXR's ZIP: deflate, then differences of bytes, then even bytes before odd ones."""
    if len(block) == size:
        return block  # it would not have become smaller
    bytes_ = bytes(itertools.accumulate(zlib.decompress(block), lambda sum_, step: (sum_ + step - 128) & 255))
    out, half = bytearray(size), (size + 1) // 2
    out[0::2], out[1::2] = bytes_[:half], bytes_[half:]
    return bytes(out)


def read_exr(path):
    """The file's width, height and channels: {"R": rows one after another, ...}. OpenEXR's file layout: attributes of
    name, type, size, value; a table of the blocks' offsets; blocks of rows with first row, size, and per row all
    channels one after another in alphabetical order."""
    with open(path, "rb") as file:
        data = file.read()

    def text(at):
        end = data.index(b"\0", at)
        return data[at:end].decode(), end + 1

    if data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError(f"{path}: not an EXR file")
    if data[5] & ~0x04:  # that bit only allows long names
        raise ValueError(f"{path}: tiled, deep or multi-part EXR; expected plain scan lines")
    at, attributes = 8, {}
    while data[at]:
        name, at = text(at)
        _, at = text(at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    compression = attributes["compression"][0]
    if compression not in ROWS_PER_BLOCK:
        raise ValueError(f"{path}: EXR compression number {compression}; write it without or with ZIP")
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1

    channels, i = [], 0  # name and format of a row
    while attributes["channels"][i]:
        end = attributes["channels"].index(b"\0", i)
        name = attributes["channels"][i:end].decode()
        (kind,) = struct.unpack_from("<i", attributes["channels"], end + 1)
        if kind not in FORMATS:
            raise ValueError(f"{path}: channel {name} is not of floating-point numbers")
        channels.append((name, f"<{width}{FORMATS[kind]}"))
        i = end + 17
    row_size = sum(struct.calcsize(row) for _, row in channels)
    planes = {name: [0.0] * (width * height) for name, _ in channels}
    rows = ROWS_PER_BLOCK[compression]
    for offset in struct.unpack_from(f"<{-(-height // rows)}Q", data, at + 1):
        first, size = struct.unpack_from("<ii", data, offset)
        count = min(rows, bottom + 1 - first)
        block, at_row = inflate(data[offset + 8:offset + 8 + size], count * row_size), 0
        for y in range(first - top, first - top + count):
            for name, row in channels:
                planes[name][y * width:(y + 1) * width] = struct.unpack_from(row, block, at_row)
                at_row += struct.calcsize(row)
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


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, struct.error, zlib.error) as problem:
        sys.exit(f"relmse.py: {problem}")
