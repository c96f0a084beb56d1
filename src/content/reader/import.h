// Reads a model file by Assimp and converts it.
#pragma once
#include "content/models/model.h"

#include <filesystem>
#include <string>

namespace lfdsim::reader {

/// `up`: "y" or "z", the file's axis that points up; "" by format. Throws std::runtime_error that says what is wrong.
Model import(const std::filesystem::path& file, const std::string& up);

}  // namespace lfdsim::reader
