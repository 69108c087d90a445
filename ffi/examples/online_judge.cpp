// Judges a log of `candump -L`, or a live bus (candump -L can0 | online_judge), as the frames come: by the edition of the
// interface that the argument says, such as 4.0, or by the default.
#include <cstdint>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "adsdv.h"

/// A judge that frees itself, and whose errors are exceptions.
class Judge {
public:
    explicit Judge(const char *version) : judge_(nullptr, &adsdv_judge_free) {
        adsdv_judge_options options;
        check(adsdv_judge_options_init(&options, &error_));
        if (version) check(adsdv_edition_find(version, &options.edition, &error_));
        judge_.reset(adsdv_judge_new(&options, &error_));
        if (!judge_) throw std::runtime_error(error_.text);
    }

    void frame(std::int64_t t_ns, std::uint32_t id, const std::vector<std::uint8_t> &data) {
        check(adsdv_judge_frame(judge_.get(), t_ns, id, data.data(), data.size(), &error_));
    }

    /// What was found since the last call; its message stays until the next.
    std::optional<adsdv_finding> next() {
        adsdv_finding finding;
        if (adsdv_judge_next(judge_.get(), &finding)) return finding;
        return std::nullopt;
    }

    adsdv_report finish() {
        adsdv_report report;
        check(adsdv_judge_finish(judge_.get(), &report, &error_));
        return report;
    }

private:
    void check(adsdv_status status) const {
        if (status != ADSDV_OK) throw std::runtime_error(error_.text);
    }

    adsdv_error error_{};
    std::unique_ptr<adsdv_judge, decltype(&adsdv_judge_free)> judge_;
};

struct Frame {
    std::int64_t t_ns;
    std::uint32_t id;
    std::vector<std::uint8_t> data;
};

/// Reads a line such as "(1795209995.234358) vcan0 520#0000010000000000".
std::optional<Frame> read(const std::string &line) {
    std::istringstream words(line);
    char open, dot;
    std::int64_t seconds;
    std::string micros, bus, frame;
    if (!(words >> open >> seconds >> dot) || !std::getline(words, micros, ')') || !(words >> bus >> frame)) return {};
    const auto hash = frame.find('#');
    if (open != '(' || dot != '.' || micros.size() != 6 || hash != 3) return {};
    const std::string hex = frame.substr(hash + 1);
    if (hex.size() % 2 != 0 || hex.find_first_not_of("0123456789ABCDEFabcdef") != std::string::npos) return {};
    std::vector<std::uint8_t> data;
    for (std::size_t at = 0; at < hex.size(); at += 2) {
        data.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(at, 2), nullptr, 16)));
    }
    const std::int64_t t_ns = (seconds * 1'000'000 + std::stoll(micros)) * 1'000;
    return Frame{t_ns, static_cast<std::uint32_t>(std::stoul(frame.substr(0, hash), nullptr, 16)), data};
}

void print_news(Judge &judge) {
    while (const auto finding = judge.next()) {
        std::cout << std::fixed << std::setprecision(6) << static_cast<double>(finding->t_ns) / 1e9 << " s  "
                  << finding->severity_name << "  " << finding->party << "  section " << finding->section << "  "
                  << finding->rule << "  " << finding->message << std::endl;
    }
}

int main(int count, char **arguments) try {
    Judge judge(count > 1 ? arguments[1] : nullptr);
    std::optional<std::int64_t> origin;
    for (std::string line; std::getline(std::cin, line);) {
        const auto frame = read(line);
        if (!frame) {
            std::cerr << "not a frame: " << line << '\n';
            continue;
        }
        if (!origin) origin = frame->t_ns;
        judge.frame(frame->t_ns - *origin, frame->id, frame->data);
        print_news(judge);
    }
    const adsdv_report report = judge.finish();
    print_news(judge);
    std::cout << report.frames << " frames, " << report.violations << " violations, " << report.warnings
              << " warnings\n";
    return report.violations == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception &problem) {
    std::cerr << "online_judge: " << problem.what() << '\n';
    return 2;
}
