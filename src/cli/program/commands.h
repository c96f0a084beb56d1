// The commands of lfdsim. Floor 5.
#pragma once
#include "cli/program/command.h"

namespace lfdsim::cli {

// Each adds its command, which runs when the command line has been parsed. What a command throws becomes the exit code: see
// main.cpp.
void add_new(Command program);
void add_import(Command program);
void add_check(Command program);
void add_eia(Command program);
void add_views(Command program);
void add_photo(Command program);
void add_render(Command program);
void add_compare(Command program);
void add_analyze(Command program);
void add_sheet(Command program);
void add_bench(Command program);
void add_view(Command program);
void add_export(Command program);
void add_glass(Command program);
void add_errors(Command program);
void add_study(Command program);  // study and tolerance
void add_doctor(Command program);

}  // namespace lfdsim::cli
