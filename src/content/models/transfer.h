// The bytes in which a model is sent from the reader process: one description for sender and receiver. Both run on the same
// machine, so numbers are in its byte order. The receiver trusts nothing that it receives, since a file may have corrupted the
// sender.
#pragma once
#include "content/models/model.h"

#include <cstdint>

namespace lfdsim {

/// The first number that is sent. After a model the model follows, after a refusal a text that says why.
enum class Reply : std::uint32_t { model = 0x4c6d6f31, refusal, out_of_memory };

/// Sends or receives a model. Io has value(x) for plain values, array(v) for vectors and strings of these, list(v, each) for
/// vectors of anything else. Each list is preceded by its count; the receiver refuses counts beyond its limits.
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
