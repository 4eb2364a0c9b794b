// The subcommands of the tool. Each adds itself with its options; its callback throws omma::Error, or ExitCode for a
// code that is no error.
#pragma once

#include "command_line.h"

namespace omma::tool {

void add_render(const Command& tool);
void add_probe(const Command& tool);
void add_compare(const Command& tool);
void add_camera(const Command& tool);
void add_cameras(const Command& tool);
void add_scenes(const Command& tool);
void add_techniques(const Command& tool);
void add_effects(const Command& tool);
void add_doctor(const Command& tool);
void add_bench(const Command& tool);

}  // namespace omma::tool
