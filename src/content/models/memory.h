// Memory that models and scenes take. Floor 2.
#pragma once
#include "content/content.h"

#include <memory>
#include <string>

namespace lfdsim {

/// The memory that models and pictures take as they were read; one that is there several times counts once.
double bytes_of(const ContentParts&);

/// The most that a scene of these takes beside them while it is made, with the key and the words for an error.
double making_scene_bytes(const ContentParts&, const Display&);
std::string making_scene_text(const ContentParts&);
std::string model_key(const Display&);

/// What a scene holds beside the models that it was made from.
double bytes_of(const ContentScene&);

/// A scene and its copies keep `other` for as long as they last.
void keep(const ContentScene&, std::shared_ptr<const void> other);
bool has_copies(const ContentScene&);

}  // namespace lfdsim
