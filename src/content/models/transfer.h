// How a model is sent from the reader process: one description of the bytes, used by writer and reader alike. Both run on the same
// machine, so native byte order. The receiver trusts nothing that it is sent, as the sender may have been corrupted by its input.
#pragma once
#include "content/models/model.h"

#include <cstdint>

namespace lfdsim {

enum class Reply : std::uint32_t { model = 0x4c6d6f31, refusal, out_of_memory };  // first; after a refusal a text says why

/// Io has value(x) for plain values, array(v) for vectors and strings of them, list(v, each) for vectors of anything else. A
/// count precedes each; the receiver refuses counts beyond its limits.
template <class Io>
void transfer(Io& io, Model& model) {
    io.array(model.positions);
    io.array(model.normals);
    io.array(model.uvs);
    io.array(model.colours);
    io.array(model.indices);
    io.array(model.material_of);
    io.array(model.materials);
    io.list(model.textures, [&](Texture& t) {
        io.value(t.width);
        io.value(t.height);
        io.array(t.rgba);
    });
    for (std::vector<std::string>* texts : {&model.notes, &model.files})
        io.list(*texts, [&](std::string& text) { io.array(text); });
}

}  // namespace lfdsim
