// analyze --compare: one display with several values of a key. Floor 5.
#pragma once
#include <string>
#include <vector>

namespace lfdsim::cli {

/// A display with one key changed.
struct Variant {
    std::string setting, name;  // "KEY=VALUE" in TOML syntax; what tells it from the others. Empty: nothing is changed
};

/// The variants that "KEY=VALUE,VALUE" or "pickup" states: the values in TOML syntax, words also bare; commas within brackets,
/// braces and quotes separate nothing. Throws InputError unless it names a key and 2 to 16 values.
std::vector<Variant> variants_of(const std::string&);

}  // namespace lfdsim::cli
