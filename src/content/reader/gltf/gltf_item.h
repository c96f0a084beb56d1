// Values of a glTF description with their paths in it, for messages: "nodes[3].mesh".
#pragma once
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace lfdsim::reader {

/// A value, or null if it is missing. Functions throw std::runtime_error for values of another type than requested.
class Item {
  public:
    using Json = nlohmann::json;
    explicit Item(const Json& json, std::string where = {}) : json_(&json), where_(std::move(where)) {}

    bool is_there() const { return !json_->is_null(); }
    bool has(const char* key) const { return at(key).is_there(); }

    /// Returns a member; null if there is none.
    Item at(const char* key) const {
        static const Json none;
        if (json_->is_null()) return Item(none, inside(key));
        if (!json_->is_object()) fail("is not an object");
        const auto found = json_->find(key);
        return Item(found == json_->end() ? none : *found, inside(key));
    }
    /// Returns an element of a list; the size() of null is 0.
    Item operator[](std::size_t i) const { return Item((*json_)[i], where_ + "[" + std::to_string(i) + "]"); }
    std::size_t size() const {
        if (json_->is_null()) return 0;
        if (!json_->is_array()) fail("is not a list");
        return json_->size();
    }

    /// Return the value, or `otherwise` (for a text: empty) if it is missing.
    double number(double otherwise) const {
        if (!is_there()) return otherwise;
        const double x = json_->is_number() ? json_->get<double>() : std::nan("");
        if (!std::isfinite(x)) fail("is not a number");
        return x;
    }
    std::size_t whole(std::size_t otherwise) const {
        if (!is_there()) return otherwise;
        // Some exporters write 3.0 for 3.
        const double x = number(0);
        if (!(x >= 0 && x <= 9e15) || x != std::floor(x)) fail("is not a whole number");
        return std::size_t(x);
    }
    bool truth(bool otherwise) const {
        if (!is_there()) return otherwise;
        if (!json_->is_boolean()) fail("is neither true nor false");
        return json_->get<bool>();
    }
    std::string text() const {
        if (!is_there()) return {};
        if (!json_->is_string()) fail("is not a text");
        return json_->get<std::string>();
    }
    template <std::size_t N>
    std::array<double, N> numbers(std::array<double, N> otherwise) const {
        if (!is_there()) return otherwise;
        if (size() != N) fail("has not " + std::to_string(N) + " numbers");
        for (std::size_t i = 0; i < N; ++i) otherwise[i] = (*this)[i].number(0);
        return otherwise;
    }

    const Json& json() const { return *json_; }
    const std::string& where() const { return where_; }
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(where_ + " " + what); }

  private:
    std::string inside(const char* key) const { return where_.empty() ? key : where_ + "." + key; }

    const Json* json_;
    std::string where_;
};

}  // namespace lfdsim::reader
