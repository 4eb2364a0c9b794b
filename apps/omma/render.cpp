// omma render: a scene through a camera into files.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>
#include <set>

#include "arguments.h"
#include "commands.h"
#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/names.h"
#include "omma/base/numbered_name.h"
#include "omma/camera/deformation/deformation.h"
#include "omma/image/write.h"
#include "omma/render/prepared_scene.h"
#include "omma/scene/object.h"
#include "omma/technique/registry.h"
#include "outputs.h"
#include "progress.h"
#include "reading.h"
#include "stats.h"
#include "view.h"

namespace omma::tool {
namespace {

namespace fs = std::filesystem;

/// As typed.
struct Options {
  std::string scene, camera, technique = "auto";
  Text size, samples, filter, background, face_size, tile, tolerance, pieces, shadows, shadow_size, reflect,
      reflection_size, stats;
  ViewOptions view;
  ReadingOptions reading;
  std::vector<std::string> outputs, effects, show;
  bool overwrite = false;
};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

Filter filter_of(const std::string& text) {
  const std::vector<std::string> names{"trilinear", "anisotropic"};
  if (text == names[0]) return Filter::trilinear;
  if (text == names[1]) return Filter::anisotropic;
  throw CommandError("{}", unknown_name("filter", text, names));
}

RenderOptions render_options_of(const Options& options) {
  constexpr int most_samples = 1024;
  RenderOptions result;
  result.technique = options.technique;
  if (options.samples) result.samples = count_of("--samples", *options.samples, 1, most_samples);
  if (options.filter) result.filter = filter_of(*options.filter);
  if (options.background) result.background = background_of(*options.background);
  for (const std::string& text : options.effects) result.effects.push_back(make_effect(text));
  for (const std::string& name : options.show) result.show.insert(show_from_name(name));
  result.count_fragments = options.stats.has_value();
  if (options.face_size) result.face_size = count_of("--face-size", *options.face_size, 1, max_image_side);
  if (options.tolerance) result.pieces.tolerance_px = number_of("--tolerance", *options.tolerance, 0.01, 100.0);
  if (options.pieces) result.pieces.count = count_of("--pieces", *options.pieces, 1, 1000000);
  set_shadows(result, options.shadows, options.shadow_size);
  if (options.reflection_size) {
    result.reflection_size = count_of("--reflection-size", *options.reflection_size, 16, max_image_side);
    if (!options.reflect) throw CommandError("--reflection-size is for the object of --reflect, and none is given");
  }
  if (options.tile) result.tile = count_of("--tile", *options.tile, 16, max_image_side);
  return result;
}

/// A rendering whose every argument has been checked; nothing has been loaded yet.
class Job {
 public:
  explicit Job(const Options& options)
      : scene_text_(options.scene),
        camera_text_(options.camera),
        outputs_(parse_outputs(options.outputs)),
        render_options_(render_options_of(options)),
        reading_(read_options_of(options.reading)),
        view_(options.view, reading_),
        camera_(first_camera(options.camera, size_option(options), view_, reading_.limits)),
        reflect_(options.reflect),
        stats_path_(options.stats),
        overwrite_(options.overwrite) {
    if (stats_path_) require_writable(*stats_path_);
    require_patterns(options.view.pose.has_value());
    for (const OutputFile& output : outputs_) {
      if (std::find(channels_.begin(), channels_.end(), output.channel) == channels_.end()) {
        channels_.push_back(output.channel);
      }
    }
    const bool has_color = std::find(channels_.begin(), channels_.end(), Channel::color) != channels_.end();
    check_show(render_options_.show, choose_technique(render_options_.technique, camera_, {.shaded = has_color}));
    if ((!effects_of(render_options_).empty() || !render_options_.show.empty()) && !has_color) {
      throw CommandError("--effect and --show change the colour alone, and no -o asks for it");
    }
  }

  void run() {
    const std::vector<Frame> frames = missing_frames();
    JobStats stats = job_stats(frames.size());
    if (frames.empty()) {
      fmt::print(stderr, "all {} frames are there already; --overwrite renders them anew\n", view_.frames().size());
    } else {
      if (stats.skipped > 0) {
        fmt::print(stderr, "{} frames are there already, {} are missing\n", stats.skipped, frames.size());
      }
      render(frames, stats);
    }
    if (stats_path_) write_stats(*stats_path_, stats);
  }

 private:
  static std::optional<ImageSize> size_option(const Options& options) {
    if (!options.size) return std::nullopt;
    return size_of("--size", *options.size);
  }

  static Camera first_camera(const std::string& text, std::optional<ImageSize> size, const View& view,
                             const Limits& limits) {
    return make_camera(changes_with_frame(text) ? text_of_frame(text, view.frames().front().number) : text, size,
                       limits);
  }

  /// A camera texture that is a sequence of files has one for each frame.
  Camera camera_of(const Frame& frame) const {
    if (!changes_with_frame(camera_text_)) return camera_;
    return make_camera(text_of_frame(camera_text_, frame.number), camera_.size(), reading_.limits);
  }

  /// Fails before the first frame is drawn where a later one would find no file.
  void require_camera_files(const std::vector<Frame>& frames) const {
    if (!changes_with_frame(camera_text_)) return;
    const std::string pattern = parse_spec(camera_text_).values.at("file");
    for (const Frame& frame : frames) {
      const fs::path path = numbered_name(pattern, frame.number);
      if (!fs::exists(path)) {
        throw InputError("{}: there is no such file, and frame {} takes its camera from it", path.string(),
                         frame.number);
      }
    }
  }

  bool numbered() const {
    return std::all_of(outputs_.begin(), outputs_.end(), [](const OutputFile& output) { return output.has_pattern(); });
  }

  void require_patterns(bool has_pose_file) const {
    for (const OutputFile& output : outputs_) {
      if (view_.is_sequence() && !output.has_pattern()) {
        const fs::path path(output.path);
        throw CommandError("-o {}: {} pictures cannot go to one file; put their number into the name: {}_%04d{}",
                           output.path, view_.frames().size(), path.stem().string(), path.extension().string());
      }
      if (!view_.is_sequence() && !has_pose_file && output.has_pattern()) {
        throw CommandError("-o {}: a numbered name is for sequences; add --frames, or --pose with a list of poses",
                           output.path);
      }
    }
  }

  /// Files are renamed into place when they are complete, so that what exists is whole.
  std::vector<Frame> missing_frames() const {
    if (!numbered()) return view_.frames();
    std::set<fs::path> folders;
    for (const OutputFile& output : outputs_) folders.insert(fs::absolute(output.path).parent_path());
    for (const fs::path& folder : folders) remove_abandoned(folder);
    if (overwrite_) return view_.frames();
    std::vector<Frame> missing;
    for (const Frame& frame : view_.frames()) {
      const bool there = std::all_of(outputs_.begin(), outputs_.end(), [&](const OutputFile& output) {
        return fs::exists(output.path_of(frame.number));
      });
      if (!there) missing.push_back(frame);
    }
    return missing;
  }

  JobStats job_stats(size_t frames) const {
    JobStats stats;
    stats.scene = scene_text_;
    stats.camera = camera_text_;
    stats.size = camera_.size();
    stats.samples = render_options_.samples;
    stats.skipped = static_cast<int>(view_.frames().size() - frames);
    return stats;
  }

  void render(const std::vector<Frame>& frames, JobStats& stats) {
    require_camera_files(frames);
    const auto begin = std::chrono::steady_clock::now();
    Scene scene = load_scene(scene_text_, reading_);
    if (view_.names_time() && scene.animations.empty()) {
      warn(fmt::format("{}: has no animation, the time changes nothing", scene_text_));
    }
    if (reflect_) render_options_.reflect = find_object(scene, *reflect_);
    view_.stand(scene, camera_);
    if (const auto time = view_.time_of(scene, frames.front())) set_time(scene, *time, view_.animation());
    if (const std::string choice = view_.unspoken_choice(scene); !choice.empty()) {
      fmt::print(stderr, "{}\n", choice);
    }
    view_.worldFromCamera(scene, frames.front());  // fails before anything slow
    stats.load_ms = milliseconds_since(begin);

    PreparedScene prepared(Device(), std::move(scene));
    if (frames.size() == 1) {
      stats.frames.push_back(write(draw(prepared, frames.front())));
      stats.setup_ms = stats.frames.back().render.setup_ms;
      report(stats.frames.back());
      return;
    }
    Progress progress("frames", static_cast<int>(frames.size()));
    // A frame is written while the next is drawn, and no more than these two are in memory. When drawing fails, the
    // frame before is still written: the future's destructor waits.
    std::future<FrameStats> writing;
    const auto finish = [&] {
      if (!writing.valid()) return;
      FrameStats frame_stats = writing.get();
      stats.setup_ms += frame_stats.render.setup_ms;
      if (stats_path_) stats.frames.push_back(std::move(frame_stats));
      progress.step();
    };
    for (const Frame& frame : frames) {
      if (const auto time = view_.time_of(prepared.scene(), frame)) prepared.set_time(*time, view_.animation());
      DrawnFrame drawn = draw(prepared, frame);
      finish();
      writing = std::async(std::launch::async,
                           [this, drawn = std::move(drawn)]() mutable { return write(std::move(drawn)); });
    }
    finish();
  }

  struct DrawnFrame {
    FrameStats stats;
    std::map<Channel, Image> images;
    ByteImage color;  ///< where no file holds more than that
    std::optional<PanoramaPlace> panorama;
  };

  DrawnFrame draw(const PreparedScene& scene, const Frame& frame) const {
    DrawnFrame drawn;
    drawn.stats.frame = frame.number;
    const Camera camera = camera_of(frame);
    const auto begin = std::chrono::steady_clock::now();
    const glm::dmat4 worldFromCamera = view_.worldFromCamera(scene.scene(), frame);
    Shot shot{camera, worldFromCamera, {}};
    for (const Channel channel : channels_) {
      if (channel == Channel::color && only_bytes_of_color()) {
        drawn.color = ByteImage(camera.size(), 3);
        std::vector<uint8_t>& bytes = drawn.color.values;
        shot.outputs.push_back(
            {channel, {.pixels = bytes.data(), .bytes = bytes.size(), .format = PixelFormat::srgb8}});
      } else {
        Image& image = drawn.images.emplace(channel, make_image(channel, camera.size())).first->second;
        shot.outputs.push_back({channel, buffer_of(image)});
      }
    }
    scene.render(shot, render_options_, &drawn.stats.render);
    drawn.stats.render_ms = milliseconds_since(begin) - drawn.stats.render.setup_ms;
    drawn.panorama = panorama_place(camera, worldFromCamera);
    return drawn;
  }

  bool only_bytes_of_color() const {
    return std::ranges::all_of(outputs_, [](const OutputFile& output) {
      return output.channel != Channel::color || holds_bytes_of_color(output.path);
    });
  }

  FrameStats write(DrawnFrame drawn) const {
    const auto begin = std::chrono::steady_clock::now();
    for (const OutputFile& output : outputs_) {
      const fs::path path = output.path_of(drawn.stats.frame);
      if (output.channel == Channel::color && only_bytes_of_color()) {
        write_image(path, drawn.color, drawn.panorama);
      } else {
        write_image(path, drawn.images.at(output.channel), output.channel, drawn.panorama);
      }
      drawn.stats.files.push_back(path.string());
    }
    drawn.stats.write_ms = milliseconds_since(begin);
    return std::move(drawn.stats);
  }

  void report(const FrameStats& frame) const {
    fmt::print(stderr, "{}: {} x {}, {} on {}, {:.1f} ms\n", fmt::join(frame.files, ", "), camera_.size().width,
               camera_.size().height, frame.render.technique, frame.render.renderer, frame.render_ms);
  }

  std::string scene_text_, camera_text_;
  std::vector<OutputFile> outputs_;
  std::vector<Channel> channels_;
  RenderOptions render_options_;
  ReadOptions reading_;
  View view_;
  Camera camera_;
  Text reflect_;  ///< the object that reflects
  std::optional<std::string> stats_path_;
  bool overwrite_;
};

std::string channel_help() {
  std::string text = "Channels (-o FILE:CHANNEL):\n";
  for (const ChannelInfo& info : channels()) text += fmt::format("  {:<10}{}\n", info.name, info.description);
  return text;
}

std::string effect_help() {
  std::string names;
  for (const EffectInfo& effect : effects()) names += fmt::format("{}{}", names.empty() ? "" : ", ", effect.name);
  return fmt::format("On surfaces: {}; may be given up to {} times, each over the last (see 'omma effects')", names,
                     max_effects);
}

std::string show_help() {
  std::string text = "Over the picture, how it is made:";
  for (const ShowInfo& info : shows()) text += fmt::format(" {} ({})", info.name, info.description);
  return text;
}

}  // namespace

void add_render(const Command& tool) {
  const Command command = tool.add_command("render", "Render a scene through a camera");
  auto options = std::make_shared<Options>();
  command.add_option("scene", options->scene, "A file that assimp reads, or a built-in scene (see 'omma scenes')")
      .type_name("SCENE")
      .required();
  command.add_option("--camera", options->camera, "A lens with its parameters, or a .npy ray map (see 'omma cameras')")
      .type_name("CAMERA")
      .required();
  command
      .add_option("-o,--output", options->outputs,
                  "File to write: .png .jpg .exr .pfm .npy; may be given several times, each with its channel")
      .type_name("FILE[:CHANNEL]")
      .one_word()
      .required();
  const auto add = [&](const char* group, const char* name, const char* type, auto& value, const char* description) {
    command.add_option(name, value, description).type_name(type).group(group);
  };
  const char* picture = "Picture";
  add(picture, "--technique", "T[:VARIANT]", options->technique, "How to draw, default auto (see 'omma techniques')");
  add(picture, "--size", "WxH", options->size, "Pixels, default 1600x1200 or the camera's own");
  add(picture, "--samples", "N", options->samples, "Colour samples a pixel, 1 to 1024, default 4");
  add(picture, "--filter", "F", options->filter, "Textures: trilinear or anisotropic (default)");
  add(picture, "--background", "sky|R,G,B", options->background, "Where nothing is: a sky (default) or linear RGB");
  add(picture, "--shadows", "KIND", options->shadows,
      "Lights cast shadows by paraboloid or cube maps of what they see, default off");
  add(picture, "--shadow-size", "N", options->shadow_size, "Texels along a shadow map, default 1024");
  add(picture, "--reflect", "OBJECT", options->reflect,
      "The object, by its node's name or its number, whose surfaces show what surrounds it");
  add(picture, "--reflection-size", "N", options->reflection_size,
      "Texels along each of the two maps of what surrounds it, default 512");
  command.add_option("--effect", options->effects, effect_help())
      .type_name("EFFECT[:KEY=VALUE,…]")
      .one_word()
      .group(picture);
  command.add_option("--show", options->show, show_help())
      .type_name("WHAT[,WHAT]")
      .delimiter(',')
      .one_word()
      .group(picture);
  add(picture, "--face-size", "N", options->face_size,
      "image-based: texels along a cube face, default the camera's density at its centre");
  add(picture, "--tolerance", "PX", options->tolerance,
      "piecewise, subdivision: how far pieces or edges may be from the camera's, pixels, default 0.25");
  add(picture, "--pieces", "N", options->pieces, "piecewise: about so many pieces of equal size instead");
  add(picture, "--tile", "N", options->tile, "Largest tile that OpenGL draws, pixels; default what the driver allows");
  const char* view = "View (without any: the scene's first camera, else its default view)";
  add(view, "--from", "X,Y,Z", options->view.from, "Where the camera stands, world metres, +Y up");
  add(view, "--to", "X,Y,Z", options->view.to, "What it looks at");
  add(view, "--up", "X,Y,Z", options->view.up, "What is up in the picture, default 0,1,0");
  add(view, "--pose", "FILE", options->view.pose,
      "Poses instead: TUM trajectory, COLMAP images.txt, or the camera nodes of a .gltf or .glb; several make a "
      "sequence");
  const char* time = "Animation and sequences";
  add(time, "--time", "SECONDS", options->view.time, "Of the scene's animation");
  add(time, "--animation", "NAME", options->view.animation, "Which of the scene's animations, default the first");
  add(time, "--frames", "N", options->view.frames, "Render N pictures over time, from --time on");
  add(time, "--fps", "F", options->view.fps, "Pictures a second of animation, default 30");
  command.add_flag("--overwrite", options->overwrite, "Render the frames of a sequence that are there already, too")
      .group(time);
  add_root(command, options->reading);
  add_limits(command, options->reading);
  add("Report", "--stats", "FILE", options->stats, "Write times, triangles, bytes and techniques as JSON");
  command.footer(
      channel_help() +
      "Examples:\n"
      "  omma render city --camera equidistant:fov_deg=180 --size 1024x1024 -o dome.png\n"
      "  omma render city --camera panini:fov_deg=150 --effect brick --effect contours:interval_m=3 -o bricks.png\n"
      "  omma render city --camera cylinder:fov_deg=360 --from -3,20,2 --to 0,5,0 -o c.png -o c.exr:distance\n"
      "  omma render robot.glb --camera equirectangular --frames 120 --fps 24 -o 'walk_%04d.jpg'\n"
      "A sequence that was cut off goes on with its first missing frame.");
  command.callback([options] { Job(*options).run(); });
}

}  // namespace omma::tool
