#!/bin/sh
# Renders the pictures of README.md and docs/effects.md into docs/images/: docs/gallery.sh
# The real scene lies in $OMMA_SHARED_DATA, or in ../shared/data beside the checkout. README.md's comparison with a cube
# map is made by docs/comparison.sh.
set -eu
cd "$(dirname "$0")/.."
sponza=${OMMA_SHARED_DATA:-../shared/data}/sponza/sponza.gltf
if [ ! -f "$sponza" ]; then
  echo "docs/gallery.sh: no $sponza; set OMMA_SHARED_DATA to the folder that holds sponza/" >&2
  exit 3
fi
mkdir -p docs/images build

# picture NAME CAMERA [OPTIONS...]: the atrium from the place that all cameras share
picture() {
  name=$1
  camera=$2
  shift 2
  ./dev render "$sponza" --camera "$camera" --from -4.5,2.2,-0.3 --to 8,3.4,-0.3 --samples 16 "$@" \
    -o "docs/images/$name.png"
}

./dev render city --camera equidistant:fov_deg=180 -o docs/images/city.png

picture perspective perspective:fov_deg=90 --size 480x480
picture equidistant equidistant:fov_deg=180 --size 480x480
picture equisolid equisolid:fov_deg=360 --size 480x480
picture orthographic_fisheye orthographic_fisheye:fov_deg=180 --size 480x480
picture stereographic stereographic:fov_deg=270 --size 480x480
picture opencv_fisheye \
  opencv_fisheye:f=190.97,cx=255.4,cy=257.4,width=512,height=512,k1=0.0035,k2=0.0007,k3=-0.0021,k4=0.0002
picture cylinder cylinder:fov_deg=360 --size 960x360
picture equirectangular equirectangular:fov_deg=360 --size 960x480

# Effects, for docs/effects.md: effect NAME SCENE CAMERA [OPTIONS...]
effect() {
  name=$1
  scene=$2
  camera=$3
  shift 3
  ./dev render "$scene" --camera "$camera" --size 480x320 --samples 16 --effect "$name" "$@" \
    -o "docs/images/effect_${name%%:*}.png"
}
effect wireframe city panini:fov_deg=150 --background 1,1,1
effect hatching city stereographic:fov_deg=150,fit=width --background 1,1,1
effect contours:interval_m=40,color=a04020 terrain panini:fov_deg=140
effect checker:size_m=2 city equidistant:fov_deg=180,fit=diagonal
effect brick:length_m=1,height_m=0.4,mortar_m=0.06 city cylinder:fov_deg=200

# Shadows and reflections, for docs/shadows.md and docs/reflections.md.
./dev render room --camera equidistant:fov_deg=170,fit=diagonal --size 480x360 --samples 16 --shadows paraboloid \
  --from -0.2,2.2,0.6 --to 0.1,0.6,-1.5 -o docs/images/shadows_room.png
./dev render city --camera panini:fov_deg=130 --size 480x360 --samples 16 --shadows cube --shadow-size 4096 \
  --from -10,30,-40 --to 0,3,0 -o docs/images/shadows_city.png
./dev render room --camera perspective:fov_deg=25 --from 0.9,1.6,0.6 --to 0.75,1,-1.5 --size 480x360 --samples 16 \
  --reflect ring --shadows paraboloid -o docs/images/reflections.png

# Pieces and triangles, for docs/pieces.md; the camera texture's offsets are made here.
./dev render city --camera cylinder:fov_deg=360 --pieces 32 --technique piecewise --show edges --show pieces \
  --size 720x540 --samples 16 -o docs/images/pieces_cylinder.png
python3 - <<'END'
import math
import struct

rows = []
for y in reversed(range(32)):  # PFM begins at the bottom
    for x in range(32):
        u, v = (x + 0.5) / 32, (y + 0.5) / 32
        fade = 0.8 * u * (1 - u) * v * (1 - v)
        rows.append((fade * math.sin(7 * v + 2 * u), fade * math.sin(6 * u - v), 0.0))

with open("build/gallery_offsets.pfm", "wb") as file:
    file.write(b"PF\n32 32\n-1.0\n")
    for row in rows:
        file.write(struct.pack("<3f", *row))
END
./dev render city --camera camera_texture:file=build/gallery_offsets.pfm,base=perspective,fov_deg=90 \
  --technique piecewise --show edges --show pieces --size 720x540 --samples 16 -o docs/images/pieces_texture.png

# A lens's rays as an array take the place of a measured camera's.
./dev camera stereographic:fov_deg=220,fit=diagonal --size 480x480 --rays build/gallery_rays.npy
picture ray_map build/gallery_rays.npy
