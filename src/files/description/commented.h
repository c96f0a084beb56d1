// A description as text with comments. Floor 2.
#pragma once
#include "files/description/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace lfdsim {

/// A description being written: keys, and comments in lines of at most a hundred columns.
class CommentedText {
  public:
    template <class... Values>
    void note(fmt::format_string<Values...> words, Values&&... values) {
        std::string text = fmt::format(words, std::forward<Values>(values)...);
        for (char& c : text)  // a file's name may contain a line break
            if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
        std::string line = "#";
        for (std::size_t start = 0; start < text.size();) {
            const std::size_t end = std::min(text.find(' ', start), text.size());
            if (line.size() > 1 && line.size() + 1 + end - start > 100) {
                all += line + "\n";
                line = "#";
            }
            line += " " + text.substr(start, end - start);
            start = end + 1;
        }
        all += line + "\n";
    }
    template <class Value>
    void key(const char* name, const Value& value) {
        all += fmt::format("{} = {}\n", name, toml_text(value));
    }
    void table(std::string_view name) { all += fmt::format("\n[{}]\n", name); }
    void list(std::string_view name) { all += fmt::format("\n[[{}]]\n", name); }  // an element of it

    std::string all;
};

/// What first designs have in common: the beginning, and the panel with its pixels. In write_first_order.cpp.
CommentedText begun_design(const std::string& name, const std::string& made_by);
struct Panel;
void write_panel_pixels(const Panel&, double inch, CommentedText&);

}  // namespace lfdsim
