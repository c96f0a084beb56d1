#include "cli/bench/bench.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <algorithm>
#include <cmath>

namespace lfdsim::cli {
namespace {

/// Processor time, user and system, that this process and its ended children have used so far.
double processor_seconds() {
    double sum = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        getrusage(who, &used);
        for (const timeval& t : {used.ru_utime, used.ru_stime}) sum += double(t.tv_sec) + double(t.tv_usec) * 1e-6;
    }
    return sum;
}

double median_of(const std::vector<double>& ascending) {
    const std::size_t n = ascending.size();
    return n == 0 ? NAN : (ascending[(n - 1) / 2] + ascending[n / 2]) / 2;
}

std::string range(double least, double most, int digits) {
    return fmt::format("({:.{}f} .. {:.{}f})", least, digits, most, digits);
}

}  // namespace

double Timing::median() const { return median_of(seconds); }
double Timing::processor_median() const { return median_of(processor_seconds); }

Json spread(const Timing& m) {
    return {{"median", m.median()},
            {"least", m.seconds.front()},
            {"most", m.seconds.back()},
            {"runs", m.seconds.size()},
            {"processor_median", m.processor_median()}};
}

Over over(const Timing& with, const Timing& plain) {
    const double ratio = with.median() / plain.median(), processor_ratio = with.processor_median() / plain.processor_median();
    return {{{"seconds", spread(with)}, {"plain_seconds", spread(plain)}, {"ratio", ratio}, {"processor_ratio", processor_ratio}},
            fmt::format("{:8.4f} s over {:8.4f} s: {:6.3f}, by processor time {:6.3f}", with.median(), plain.median(), ratio,
                        processor_ratio)};
}

Bench::Bench(const BenchSettings& s, Progress& progress) : settings(s), progress_(progress) {}

std::vector<Timing> Bench::measure(std::string_view stage, const std::vector<Case>& cases) {
    std::vector<Timing> all;
    for (const Case& c : cases) all.push_back({c.name, {}, {}, 0});
    progress_.stage(stage, std::int64_t(cases.size()) * settings.runs);
    Quiet job(progress_);  // the bar counts runs, not the work inside each
    for (int run = 0; run < settings.runs; ++run)
        for (std::size_t i = 0; i < cases.size() && !cancelled(); ++i) {
            const double before = processor_seconds();
            const Run r = cases[i].run(job);
            if (cancelled()) break;
            all[i].seconds.push_back(r.seconds);
            all[i].processor_seconds.push_back(processor_seconds() - before);
            all[i].count = r.count;
            progress_.advance(1);
        }
    progress_.end();
    std::erase_if(all, [](const Timing& m) { return m.seconds.empty(); });
    for (Timing& m : all)
        for (auto* values : {&m.seconds, &m.processor_seconds}) std::sort(values->begin(), values->end());
    return all;
}

void Bench::heading(const std::string& text) {
    progress_.end();
    if (!settings.json) print("\n" + text + "\n");
}

void Bench::row(const std::string& group, Json values, const std::string& text) {
    progress_.end();
    groups_[group].push_back(std::move(values));
    if (!settings.json) print("  " + text + "\n");
}

void Bench::rates(const std::string& group, const char* unit, const std::vector<Timing>& all) {
    for (const Timing& m : all) {
        const double relative = m.rate() / all.front().rate(), millions = m.count / 1e6;
        row(group,
            {{"name", m.name}, {fmt::format("m{}_per_s", unit), m.rate() / 1e6}, {"relative", relative}, {"seconds", spread(m)}},
            fmt::format("{:<32} {:8.1f} million {}/s {:<18} {:8.3f}", m.name, m.rate() / 1e6, unit,
                        range(millions / m.seconds.back(), millions / m.seconds.front(), 1), relative));
    }
}

void Bench::seconds(const std::string& group, const char* unit, const std::vector<Timing>& all) {
    for (const Timing& m : all) {
        Json values{{"name", m.name}, {"seconds", spread(m)}};
        std::string text =
            fmt::format("{:<32} {:8.4f} s {:<20}", m.name, m.median(), range(m.seconds.front(), m.seconds.back(), 4));
        if (m.count > 0) {
            values[fmt::format("m{}_per_s", unit)] = m.rate() / 1e6;
            text += fmt::format(" {:8.1f} million {}/s", m.rate() / 1e6, unit);
        }
        row(group, std::move(values), text);
    }
}

void Bench::not_measured(const std::string& group, const std::string& name, const std::string& why) {
    row(group, {{"name", name}, {"not_measured", why}}, fmt::format("{:<32} not measured: {}", name, why));
}

}  // namespace lfdsim::cli
