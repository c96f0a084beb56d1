// The warnings of Assimp's loaders.
#pragma once
#include <assimp/DefaultLogger.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace lfdsim::reader {

/// Collects the first eight different warnings and errors.
class Warnings : public Assimp::LogStream {
  public:
    static constexpr std::size_t most = 8;

    void write(const char* message) override {
        std::string text(message);
        if (const std::size_t prefix = text.find(": "); prefix != std::string::npos) text.erase(0, prefix + 2);  // "Warn,  T0: "
        while (!text.empty() && text.back() == '\n') text.pop_back();
        if (texts.size() < most && std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(std::move(text));
    }

    std::vector<std::string> texts;
};

}  // namespace lfdsim::reader
