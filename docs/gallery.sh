#!/bin/sh
# Renders the pictures of README.md into docs/images/: docs/gallery.sh
# The real scene lies in $OMMA_SHARED_DATA, or in ../shared/data beside the checkout.
set -eu
cd "$(dirname "$0")/.."
data=${OMMA_SHARED_DATA:-../shared/data}
sponza=$data/sponza/sponza.gltf
if [ ! -f "$sponza" ]; then
  echo "docs/gallery.sh: no $sponza; set OMMA_SHARED_DATA to the folder that holds sponza/" >&2
  exit 3
fi
mkdir -p docs/images build
atrium="$sponza --from -9,2.2,-0.3 --to 4,3.2,-0.3 --samples 16"

# The rays of a lens, as a calibration could have measured them.
./dev camera stereographic:fov_deg=220,fit=diagonal --size 480x480 --rays build/gallery_rays.npy

./dev render city --camera equidistant:fov_deg=180 --size 800x800 --samples 16 -o docs/images/city.png
./dev render $atrium --camera perspective:fov_deg=90 --size 640x480 -o docs/images/perspective.png
./dev render $atrium --camera equidistant:fov_deg=180 --size 480x480 -o docs/images/equidistant.png
./dev render $atrium --camera equisolid:fov_deg=360 --size 480x480 -o docs/images/equisolid.png
./dev render $atrium --camera orthographic_fisheye:fov_deg=180 --size 480x480 -o docs/images/orthographic_fisheye.png
./dev render $atrium --camera stereographic:fov_deg=270 --size 480x480 -o docs/images/stereographic.png
./dev render $atrium --camera opencv_fisheye:fx=190.98,fy=190.97,cx=254.93,cy=256.90,k1=0.00348,k2=0.00077,k3=-0.00205,k4=0.0002,width=512,height=512 -o docs/images/opencv_fisheye.png
./dev render $atrium --camera cylinder:fov_deg=360 --size 960x360 -o docs/images/cylinder.png
./dev render $atrium --camera equirectangular:fov_deg=360 --size 960x480 -o docs/images/equirectangular.png
./dev render $atrium --camera build/gallery_rays.npy -o docs/images/ray_map.png
