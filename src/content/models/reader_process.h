// The model reader as a child process, and the pipe to which it writes.
#pragma once
#include "content/content.h"

#include <sys/types.h>
#include <chrono>
#include <stdexcept>

namespace lfdsim {

/// A reader process, started by the constructor: an Io for transfer() that receives bytes until the time or the byte limit is
/// spent. value(), array() and list() throw Failure.
class ReaderProcess {
  public:
    /// Thrown if the reader crashed, ran out of time or memory, or sent something impossible; what() is for the user.
    struct Failure : std::runtime_error {
        using std::runtime_error::runtime_error;
    };

    /// `what`: "model" or "picture". Throws std::runtime_error if the reader program is missing or cannot be started.
    ReaderProcess(const std::string& what, const std::filesystem::path&, const LoadOptions&);
    ~ReaderProcess();  // kills the reader if it still runs
    ReaderProcess(const ReaderProcess&) = delete;

    template <class T>
    void value(T& x) {
        get(reinterpret_cast<char*>(&x), sizeof x);
    }
    template <class Vector>
    void array(Vector& v) {
        constexpr std::size_t size = sizeof(typename Vector::value_type), step = (std::size_t(4) << 20) / size;
        std::size_t left = count(size);
        while (left > 0) {  // the list grows as bytes arrive, so that a false count allocates little
            const std::size_t old = v.size(), more = std::min(left, std::max(step, old));
            v.resize(old + more);
            get(reinterpret_cast<char*>(v.data() + old), more * size);
            left -= more;
        }
    }
    template <class T, class Each>
    void list(std::vector<T>& v, Each each) {
        for (std::size_t left = count(1); left > 0; --left) each(v.emplace_back());
    }

  private:
    /// Reads bytes. Throws Failure after the deadline, beyond the byte limit, if cancelled, and at the pipe's end.
    void get(char* to, std::size_t bytes);
    /// Reads the number of elements of a list, each of at least `size` bytes. Throws Failure if they would exceed the byte limit.
    std::size_t count(std::size_t size);
    [[noreturn]] void fail();

    LoadOptions options_;
    std::chrono::steady_clock::time_point deadline_;
    std::int64_t left_;  // bytes that may still arrive
    int pipe_ = -1;
    pid_t process_ = -1;
};

/// Returns why a file is refused that needs more memory than the limit.
std::string too_large_text(const LoadOptions&);

}  // namespace lfdsim
