// Why a model is not read.
#pragma once
#include "small_world.h"

namespace small_world {

/// The error's words; a failure where there is none.
inline std::string refused(const fs::path& file) {
    try {
        load_model(file);
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << file << " was read";
    return {};
}

}  // namespace small_world
