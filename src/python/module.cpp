#include "base/printable.h"
#include "engine/devices/threads.h"
#include "python/parts.h"
#include "report/folder/folder_lock.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <new>

// lfdsim._core: the functions that the Python package in python/lfdsim calls. Names, defaults and texts that users see are in the
// package.
namespace lfdsim::python {
namespace {

namespace nb = nanobind;

/// Sets Python's current exception to lfdsim.errors.NAME of [(where, what)].
void raise(const char* name, const InputError& error) {
    nb::list problems;
    for (const Problem& p : error.problems)
        problems.append(nb::make_tuple(bounded(printable_lines(p.where)), bounded(printable_lines(p.what))));
    const nb::object type = nb::module_::import_("lfdsim.errors").attr(name);
    PyErr_SetObject(type.ptr(), type(problems).ptr());
}

/// Translates exceptions of C++ for nanobind, which handles those that leave this function.
void translate(const std::exception_ptr& thrown, void*) {
    try {
        std::rethrow_exception(thrown);
    } catch (const DisplayFault& fault) {
        raise("DisplayError", fault);
    } catch (const InputError& error) {
        raise("InputError", error);
    } catch (const std::bad_alloc&) {
        PyErr_SetString(PyExc_MemoryError, "out of memory; make the picture or the panel smaller, or use fewer threads");
    }
}

}  // namespace
}  // namespace lfdsim::python

NB_MODULE(_core, m) {
    lfdsim::use_only_threads_to_be_had();
    m.attr("version") = LFDSIM_VERSION;
    nanobind::register_exception_translator(lfdsim::python::translate);
    m.def("harmless", &lfdsim::printable_lines, nanobind::arg("text"));
    m.def(
        "shown", [](const std::string& text) { return lfdsim::bounded(lfdsim::printable_lines(text)); }, nanobind::arg("text"));
    nanobind::class_<lfdsim::FolderLock>(m, "FolderLock").def(nanobind::init<const std::string&>(), nanobind::arg("folder"));
    lfdsim::python::add_display(m);
    lfdsim::python::add_pictures(m);
    lfdsim::python::add_photographs(m);
    lfdsim::python::add_analyze(m);
}
