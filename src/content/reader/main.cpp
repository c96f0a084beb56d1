// lfdsim-model-reader model|picture FILE BYTES SECONDS UP: reads a model, or a picture as one, and writes it to standard output in
// the form of transfer.h.
// A process of its own, with limits, since loaders of old formats have memory faults that a hostile file can reach.
#include "base/large_stack.h"
#include "content/models/transfer.h"
#include "content/reader/import.h"
#include "content/reader/limits/limits.h"
#include "content/reader/picture.h"

#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

/// Writes a model to standard output: an Io for transfer().
class ModelWriter {
  public:
    template <class T>
    void value(const T& x) {
        put(&x, sizeof x);
    }
    template <class Vector>
    void array(const Vector& v) {
        value(std::uint64_t(v.size()));
        put(v.data(), v.size() * sizeof v[0]);
    }
    template <class T, class Each>
    void list(std::vector<T>& v, Each each) {
        value(std::uint64_t(v.size()));
        for (T& x : v) each(x);
    }

  private:
    static void put(const void* bytes, std::size_t count) {
        if (std::fwrite(bytes, 1, count, stdout) != count) std::_Exit(1);  // the parent no longer reads
    }
};

}  // namespace

namespace {

// Does what the command line says, writes the reply, and ends the process.
int answer(int count, char** arguments) {
    if (count != 6) {
        std::fputs("lfdsim-model-reader is started by lfdsim, not by hand\n", stderr);
        return 2;
    }
    ModelWriter out;
    try {
        lfdsim::reader::confine(std::atoll(arguments[3]), std::atof(arguments[4]));
        lfdsim::reader::allow_for(arguments[2]);
        const bool is_picture = std::string(arguments[1]) == "picture";
        lfdsim::Model model =
            is_picture ? lfdsim::reader::picture(arguments[2]) : lfdsim::reader::import(arguments[2], arguments[5]);
        out.value(lfdsim::Reply::model);
        lfdsim::transfer(out, model);
    } catch (const std::bad_alloc&) {
        out.value(lfdsim::Reply::out_of_memory);
    } catch (const std::exception& refusal) {
        out.value(lfdsim::Reply::refusal);
        out.array(std::string(refusal.what()));
    }
    std::fflush(stdout);
    std::_Exit(0);  // no destructors: a damaged model may have corrupted memory
}

}  // namespace

int main(int count, char** arguments) {
    return lfdsim::on_enough_stack([&] { return answer(count, arguments); });
}
