#!/bin/sh
# Renders a picture of each camera's example for docs/cameras.md and docs/deformations.md into docs/images/cameras/:
# docs/camera_pictures.sh [NAME...]; ./dev docs runs it for the pictures that are missing. OMMA names the tool.
set -eu
cd "$(dirname "$0")/.."
omma=${OMMA:-build/default/bin/omma}
folder=docs/images/cameras
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"

# Files that deformations read: offsets that ripple over 90 x 60 pixels (PFM, rows from the bottom), and a mesh that
# lays the picture out on a disc (Paul Bourke's polar form).
awk 'BEGIN {
  for (y = 0; y < 60; ++y) for (x = 0; x < 90; ++x) {
    dx = (x - 44.5) / 60; dy = (y - 29.5) / 60; r = sqrt(dx * dx + dy * dy)
    wave = r > 0 ? 0.02 * sin(40 * r) / r : 0
    print wave * dx / 1.5, -wave * dy, 0
  }
}' | perl -ane 'BEGIN { binmode STDOUT; print "PF\n90 60\n-1.0\n" } print pack("f<3", @F)' >"$work/offsets.pfm"
awk 'BEGIN {
  print 2; print 25, 17
  for (j = 0; j < 17; ++j) for (i = 0; i < 25; ++i) {
    u = i / 24; v = j / 16
    print 1.5 * (2 * u - 1) * (0.75 + 0.25 * cos(3 * (v - 0.5))), (2 * v - 1) * (0.7 + 0.3 * cos(3 * (u - 0.5))), u, v, 1
  }
}' >"$work/mesh.data"

# NAME CAMERA, one a line
cameras() {
  "$omma" cameras --examples
  echo "expression" "expression:r=if(theta<0.5,theta,0.5+2*(theta-0.5)),fov_deg=180,width=720,height=480"
  echo "camera_texture" "camera_texture:file=$work/offsets.pfm,base=perspective,fov_deg=100"
  echo "warp_mesh" "warp_mesh:file=$work/mesh.data,base=perspective,fov_deg=100,base_width=360,base_height=240"
}

# What a camera's own size becomes: at most 270 x 180. Without one, whole panoramas are twice as wide as high.
size_of() {
  echo "$1" | awk -F'[:,]' '{
    for (i = 2; i <= NF; ++i) { split($i, pair, "="); value[pair[1]] = pair[2] }
    w = value["width"]; h = value["height"]
    if (!w) { w = 270; h = value["fov_deg"] == 360 ? 135 : 180 }
    scale = w / 270 > h / 180 ? 270 / w : 180 / h
    printf "%dx%d", w * scale + 0.5, h * scale + 0.5
  }'
}

cameras | while read -r name camera; do
  if [ $# -gt 0 ]; then
    case " $* " in *" $name "*) ;; *) continue ;; esac
  elif [ -f "$folder/$name.jpg" ]; then
    continue
  fi
  "$omma" render city --camera "$camera" --size "$(size_of "$camera")" --samples 16 -o "$folder/$name.jpg" </dev/null
done
