// The values of analyze --compare: one display with several values of a key. Floor 5.
#pragma once
#include <string>
#include <vector>

namespace lfdsim::cli {

/// A display with one key changed.
struct Variant {
    std::string setting, name;  // "KEY=VALUE" in TOML syntax; "KEY-VALUE", the name of its results. Empty: nothing is changed
};

/// Returns the variants of "KEY=VALUE,VALUE" or "pickup": values are in TOML syntax, words also without quotes; commas within
/// brackets, braces and quotes do not separate values. Throws InputError unless the text names a key and 2 to 16 values.
std::vector<Variant> variants_of(const std::string&);

}  // namespace lfdsim::cli
