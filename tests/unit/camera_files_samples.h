// A calibration file of each format, as its program writes it.
#pragma once

#include <string>
#include <vector>

namespace omma {

struct SampleFile {
  const char* format;
  std::string text;
};

inline const std::vector<SampleFile>& sample_files() {
  static const std::vector<SampleFile> files = {
      {"opencv", R"(%YAML:1.0
---
image_width: 640
image_height: 480
fisheye_model: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.3591573396163199e+02, 0., 3.4228315473308373e+02, 0., 5.3591573396163199e+02,
       2.3557082909788173e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.6637260909660682e-01, -3.8588898922304653e-02, 1.7831947042852964e-03,
       -2.8122100441115472e-04, 2.3839153080878486e-01 ]
)"},
      {"opencv", R"(<?xml version="1.0"?>
<opencv_storage>
<image_width>640</image_width>
<image_height>480</image_height>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>
    400. 0. 319.5 0. 410. 239.5 0. 0. 1.</data></camera_matrix>
<xi type_id="opencv-matrix"><rows>1</rows><cols>1</cols><dt>d</dt><data>1.25</data></xi>
<distortion_coefficients type_id="opencv-matrix">
  <rows>1</rows>
  <cols>4</cols>
  <dt>d</dt>
  <data>-0.1 0.02 1e-3 -2e-3</data></distortion_coefficients>
</opencv_storage>
)"},
      {"ros", R"(image_width: 640
image_height: 480
camera_name: head
camera_matrix:
  rows: 3
  cols: 3
  data: [430.15, 0, 306.69, 0, 430.53, 227.22, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.3375, 0.1117, -0.0011, -0.0002, 0.003]
)"},
      {"kalibr", R"(cam0:
  camera_model: omni
  distortion_coeffs: [-0.2, 0.05, 0.001, -0.002]
  distortion_model: radtan
  intrinsics: [1.5, 800.5, 801.5, 320.25, 240.75]
  resolution: [640, 480]
cam1:
  camera_model: ds
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [-0.17, 0.59, 158.25, 158.5, 254.75, 256.5]
  resolution: [512, 512]
)"},
      {"camodocal", R"(%YAML:1.0
---
model_type: KANNALA_BRANDT
camera_name: left
image_width: 752
image_height: 480
projection_parameters:
   k2: -0.01
   k3: 0.02
   k4: -0.003
   k5: 0.0004
   mu: 461.5
   mv: 460.25
   u0: 366.5
   v0: 249.5
)"},
      {"basalt", R"({"value0": {"intrinsics": [
  {"camera_type": "ucm", "intrinsics": {"fx": 380.5, "fy": 381.5, "cx": 254.5, "cy": 256.25, "alpha": 0.61}}],
  "resolution": [[512, 512]]}}
)"},
      {"colmap", R"(# Camera list
1 SIMPLE_RADIAL 3072 2304 2559.81 1536 1152 -0.0204997
2 FULL_OPENCV 640 480 500.5 501.5 320.25 240.75 0.1 -0.2 0.001 -0.002 0.03 0.11 -0.21 0.031
3 EUCM 512 512 191.25 191.5 255.5 257.25 0.63 1.04
)"},
      {"nerfstudio", R"({"camera_model": "OPENCV_FISHEYE", "fl_x": 293.5, "fl_y": 294.5, "cx": 320.25, "cy": 240.5,
 "w": 640, "h": 480, "k1": 0.05, "k2": -0.01, "k3": 0.002, "k4": -0.0003,
 "frames": [{"file_path": "images/1.png"}]}
)"},
      {"ocamcalib", R"(#polynomial coefficients for the DIRECT mapping function

5 -471.4441 0 7.356108e-04 -3.773045e-07 5.800006e-10

#inverse

3 772.4 504.7 7.03

#center: "row" and "column", starting from 0 (C convention)

794.25 798.5

#affine parameters "c", "d", "e"

1.000305 -0.000277 -0.000925

#image size: "height" and "width"

1590 1600
)"},
      {"nvidia", R"({"cam_front@1": {"logical_sensor_name": "front", "camera_model_type": "ftheta",
 "resolution": [3840, 2160], "external_distortion": null, "intrinsics": {
 "principal_point": [1919.5, 1079.5], "reference_poly": "2",
 "pixeldist_to_angle_poly": [0.0, 0.0005, 0.0, 0.0, 0.0, 0.0],
 "angle_to_pixeldist_poly": [0.0, 1888.5, -41.5, 11.5, -18.25, 6.5],
 "max_angle_rad": 1.25, "linear_cde": [0.9996, 3.4e-06, 3.7e-05]}}}
)"},
      {"usd", R"({"omni:lensdistortion:model": "ftheta",
 "omni:lensdistortion:ftheta:nominalWidth": 1936, "omni:lensdistortion:ftheta:nominalHeight": 1216,
 "omni:lensdistortion:ftheta:opticalCenter": [970.9424, 600.375], "omni:lensdistortion:ftheta:maxFov": 200,
 "omni:lensdistortion:ftheta:k0": 0, "omni:lensdistortion:ftheta:k1": 0.00245,
 "omni:lensdistortion:ftheta:k2": 0, "omni:lensdistortion:ftheta:k3": 0, "omni:lensdistortion:ftheta:k4": 0}
)"},
      {"usd", R"({"left": {"focalLength": 2, "horizontalAperture": 8, "verticalAperture": 5,
 "omni:lensdistortion:model": "kannalaBrandtK3", "omni:lensdistortion:kannalaBrandtK3:nominalWidth": 1600.0,
 "omni:lensdistortion:kannalaBrandtK3:nominalHeight": 1200, "omni:lensdistortion:kannalaBrandtK3:maxFov": 170,
 "omni:lensdistortion:kannalaBrandtK3:opticalCenter": [801.5, 598.25], "omni:lensdistortion:kannalaBrandtK3:k0": 0.05,
 "omni:lensdistortion:kannalaBrandtK3:k1": 0.01, "omni:lensdistortion:kannalaBrandtK3:k2": -0.003,
 "omni:lensdistortion:kannalaBrandtK3:k3": -0.0005},
 "right": {"focalLength": 1.5, "horizontalAperture": 3.5, "omni:lensdistortion:model": "radTanThinPrism",
 "omni:lensdistortion:radTanThinPrism:nominalWidth": 1400, "omni:lensdistortion:radTanThinPrism:nominalHeight": 1408,
 "omni:lensdistortion:radTanThinPrism:maxFov": 150, "omni:lensdistortion:radTanThinPrism:opticalCenter": [714.5, 704],
 "omni:lensdistortion:radTanThinPrism:k0": 0.4, "omni:lensdistortion:radTanThinPrism:k1": -0.48,
 "omni:lensdistortion:radTanThinPrism:k2": 0.11, "omni:lensdistortion:radTanThinPrism:k3": 0.09,
 "omni:lensdistortion:radTanThinPrism:k4": -0.05, "omni:lensdistortion:radTanThinPrism:k5": 0.0073,
 "omni:lensdistortion:radTanThinPrism:p0": -0.0005, "omni:lensdistortion:radTanThinPrism:p1": 0.0003,
 "omni:lensdistortion:radTanThinPrism:s0": 0.0006, "omni:lensdistortion:radTanThinPrism:s1": -0.00022,
 "omni:lensdistortion:radTanThinPrism:s2": 0.0004, "omni:lensdistortion:radTanThinPrism:s3": -0.00014}}
)"},
      {"woodscape", R"({"intrinsic": {"aspect_ratio": 1.0, "cx_offset": 3.942, "cy_offset": -3.093, "height": 966.0,
 "k1": 339.749, "k2": -31.988, "k3": 48.275, "k4": -7.201, "model": "radial_poly", "poly_order": 4,
 "width": 1280.0}, "name": "FV"}
)"},
      {"stella", R"(Camera:
  name: "fisheye"
  model: "fisheye"
  fx: 441.75
  fy: 442.5
  cx: 480.25
  cy: 275.5
  k1: -0.03
  k2: -0.003
  k3: -0.002
  k4: -0.0005
  cols: 960
  rows: 540
)"},
      {"maplab", R"(sensors:
  - id: a1
    sensor_type: IMU
  - id: b2
    sensor_type: NCAMERA
    cameras:
      - camera:
          id: c3
          image_height: 1080
          image_width: 1440
          type: pinhole
          intrinsics: {rows: 4, cols: 1, data: [701.5, 701.25, 703.5, 530.25]}
          distortion:
            type: fisheye
            parameters: {rows: 1, cols: 1, data: [0.93]}
)"},
      {"sdf", R"(<?xml version="1.0"?>
<sdf version="1.6"><model name="m"><link name="l"><sensor name="wide" type="wideanglecamera"><camera>
  <horizontal_fov>3.14159265</horizontal_fov>
  <image><width>800</width><height>600</height></image>
  <lens><type>custom</type><custom_function><c1>1.05</c1><c2>4</c2><f>1.0</f><fun>tan</fun></custom_function>
    <scale_to_hfov>true</scale_to_hfov><cutoff_angle>1.5707</cutoff_angle></lens>
</camera></sensor></link></model></sdf>
)"},
      {"sdf", R"(<sdf version="1.9"><sensor name="front" type="camera"><camera>
  <horizontal_fov>1.0471975512</horizontal_fov>
  <image><width>640</width><height>480</height></image>
  <distortion><k1>-0.25</k1><k2>0.12</k2><k3>-0.03</k3><p1>0.001</p1><p2>-0.002</p2><center>0.5 0.5</center></distortion>
</camera></sensor></sdf>
)"},
      {"pieces", R"({"size":[64,48],"pieces":[
{"corners":[[0.0,0.0],[32.0,0.0],[32.0,48.0],[0.0,48.0]],"imageFromRay":[[32.0,0.0,-32.0],[0.0,-32.0,-24.0],[0.0,0.0,-1.0]]},
{"corners":[[32.0,0.0],[64.5,0.0],[32.0,60.25]],"imageFromRay":[[30,0.0,-32.0],[0.0,-32.0,-24.0],[0.125,0.0,-1.0]]}
]}
)"},
  };
  return files;
}

}  // namespace omma
