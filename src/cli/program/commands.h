// The list of the commands of lfdsim. Floor 5.
#pragma once
#include "cli/program/command.h"

namespace lfdsim::cli {

// The macro has a line for each command, in the order of help. The file commands/NAME.cpp defines NAME_command(). The exit code
// follows from the exception that a command throws: see main.cpp.
#define LFDSIM_COMMANDS(COMMAND) \
    COMMAND(new)                 \
    COMMAND(import)              \
    COMMAND(check)               \
    COMMAND(eia)                 \
    COMMAND(views)               \
    COMMAND(photo)               \
    COMMAND(render)              \
    COMMAND(compare)             \
    COMMAND(analyze)             \
    COMMAND(sheet)               \
    COMMAND(view)                \
    COMMAND(export)              \
    COMMAND(bench)               \
    COMMAND(glass)               \
    COMMAND(errors)              \
    COMMAND(study)               \
    COMMAND(tolerance)           \
    COMMAND(doctor)

#define LFDSIM_DECLARE_COMMAND(NAME) CommandSpec NAME##_command();
LFDSIM_COMMANDS(LFDSIM_DECLARE_COMMAND)
#undef LFDSIM_DECLARE_COMMAND

}  // namespace lfdsim::cli
