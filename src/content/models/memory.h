// The memory that models and scenes take. Floor 2.
#pragma once
#include "content/content.h"

#include <memory>
#include <string>

namespace lfdsim {

/// Returns the bytes that models and pictures take as they were read; one that occurs several times counts once.
double bytes_of(const ContentParts&);

/// Returns the most bytes that a scene of these parts takes besides them while it is made.
double making_scene_bytes(const ContentParts&, const Display&);
/// Return the words and the key for the error if there is not enough memory.
std::string making_scene_text(const ContentParts&);
std::string model_key(const Display&);

/// Returns the bytes that a scene takes besides the models that it was made from.
double bytes_of(const ContentScene&);

/// Makes a scene and its copies keep `other` for as long as they exist.
void keep(const ContentScene&, std::shared_ptr<const void> other);
/// Returns whether the scene has copies.
bool has_copies(const ContentScene&);

}  // namespace lfdsim
