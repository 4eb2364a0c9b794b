// The subcommands of the tool. Each adds itself with its options; its callback throws omma::Error, or ExitCode for a
// code that is no error.
#pragma once

#include <CLI/App.hpp>

#include "program.h"

namespace omma::tool {

void add_render(CLI::App& tool);
void add_probe(CLI::App& tool);
void add_compare(CLI::App& tool);
void add_camera(CLI::App& tool);
void add_cameras(CLI::App& tool);
void add_scenes(CLI::App& tool);
void add_techniques(CLI::App& tool);
void add_effects(CLI::App& tool);
void add_doctor(CLI::App& tool);
void add_bench(CLI::App& tool);

}  // namespace omma::tool
