#!/bin/sh
# Makes README.md's comparison of a cube map with Omma into docs/images/cube_map.png, and prints what each of the two
# takes a frame: docs/comparison.sh. The machine should have nothing else to do.
set -eu
cd "$(dirname "$0")/.."
work=build/comparison
mkdir -p docs/images "$work"
rm -f "$work"/*

# frames NAME TECHNIQUE: the picture nine times over, what each took in stats.json
frames() {
  ./dev render city --camera equidistant:fov_deg=180 --size 1600x1200 --technique "$2" --frames 9 --overwrite \
    --stats "$work/$1.json" -o "$work/$1_%d.npy" 2>"$work/$1.log" || { cat "$work/$1.log" >&2; exit 4; }
}
for name in 1 2 3; do  # in turn, so that what disturbs the machine disturbs both alike
  frames "cube_$name" image-based
  frames "omma_$name" auto
done

python3 - "$work" <<'END'
import ast
import json
import statistics
import struct
import sys
import zlib

work = sys.argv[1]
left, top, width, height, times = 262, 556, 104, 78, 4  # of the crop, and how much it is magnified


def read_colours(path):
    """Rows of pixels of three floats, linear."""
    with open(path, "rb") as file:
        magic = file.read(10)
        header = ast.literal_eval(file.read(struct.unpack("<H", magic[8:])[0]).decode())
        rows, columns, _ = header["shape"]
        for _ in range(rows):
            row = struct.unpack(f"<{3 * columns}f", file.read(12 * columns))
            yield [row[i : i + 3] for i in range(0, len(row), 3)]


def to_byte(linear):
    value = min(max(linear, 0.0), 1.0)
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))


def magnified_crop(path):
    for y, row in enumerate(read_colours(path)):
        if not top <= y < top + height:
            continue
        line = b"".join(bytes(map(to_byte, pixel)) * times for pixel in row[left : left + width])
        yield from [line] * times


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


gap = b"\xff" * (3 * 8)
lines = [a + gap + b for a, b in zip(magnified_crop(f"{work}/cube_1_0.npy"), magnified_crop(f"{work}/omma_1_0.npy"))]
with open("docs/images/cube_map.png", "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n")
    file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", len(lines[0]) // 3, len(lines), 8, 2, 0, 0, 0)))
    file.write(chunk(b"IDAT", zlib.compress(b"".join(b"\x00" + line for line in lines), 9)))
    file.write(chunk(b"IEND", b""))

medians = {}
for name in ("cube", "omma"):
    frame_ms = []
    for run in (1, 2, 3):
        with open(f"{work}/{name}_{run}.json") as file:
            frame_ms += [frame["render_ms"] for frame in json.load(file)["frames"][1:]]  # the first one prepares
    medians[name] = statistics.median(frame_ms)
print("cube map {cube:.0f} ms, Omma {omma:.0f} ms a frame".format(**medians), end=", ")
print(f"{medians['cube'] / medians['omma']:.1f} : 1")
END
