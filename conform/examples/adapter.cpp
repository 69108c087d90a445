// A complete adapter in C++17 for `adsdv conform`, around the specification as a C library.
//
//     cargo build --release -p adsdv-ffi
//     c++ -std=c++17 -O2 -Iffi/include conform/examples/adapter.cpp target/release/libadsdv.a -lpthread -ldl -lm -o adapter
//     adsdv conform [--edition 4.0] -- ./adapter
// Put your own VCU in place of Vcu::step. conform/PROTOCOL.md says what the lines mean.
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "adsdv.h"

namespace {
void check(adsdv_status status, const adsdv_error &error) {
    if (status != ADSDV_OK) throw std::runtime_error(error.text);
}

// A line of the protocol: a value is found by its key.
class Line {
  public:
    explicit Line(std::string_view text) : text_(text) {}
    bool flag(const char *key) const { return after(key).substr(0, 4) == "true"; }
    long number(const char *key) const {
        // What is not in the line is at its default.
        return std::strtol(std::string(after(key).substr(0, 12)).c_str(), nullptr, 10);
    }
    std::string_view text(const char *key) const {
        const std::string_view value = after(key);
        return value.empty() ? value : value.substr(1, value.find('"', 1) - 1);
    }
    // The value of an enumeration, by its name.
    int named(adsdv_edition edition, const char *key, unsigned enumeration, int otherwise) const {
        const std::string_view name = text(key);
        if (name.empty()) return otherwise;
        std::int32_t number = 0;
        adsdv_error error;
        check(adsdv_value_of_name_in(edition, enumeration, name.data(), name.size(), &number, &error), error);
        return number;
    }

  private:
    std::string_view after(const char *key) const {
        const std::string quoted = '"' + std::string(key) + "\":";
        const auto at = text_.find(quoted);
        return at == std::string_view::npos ? std::string_view() : text_.substr(at + quoted.size());
    }
    std::string_view text_;
};

// A VCU of an edition that keeps its control state.
class Vcu {
  public:
    explicit Vcu(adsdv_edition edition) {
        check(adsdv_machine_init_in(edition, &machine_, nullptr, &error_), error_);
        check(adsdv_control_init(&control_, &error_), error_);
    }
    adsdv_edition edition() const { return machine_.edition; }
    adsdv_outputs step(const Line &line) {
        adsdv_inputs in;
        adsdv_outputs out;
        check(adsdv_inputs_init(&in, &error_), error_);
#define FLAG(key) in.key = line.flag(#key);
#define NUMBER(key) in.key = static_cast<decltype(in.key)>(line.number(#key));
#define NAME(key, of) in.key = static_cast<decltype(in.key)>(line.named(edition(), #key, of, in.key));
        FLAG(asms) FLAG(tsms) FLAG(go) FLAG(remote_estop) FLAG(res_link_lost) FLAG(vehicle_estop) FLAG(crash_sensor)
        FLAG(critical_fault) FLAG(bms_fault) FLAG(mpp_dongle_removed) FLAG(hvil_open) FLAG(hvil_short) FLAG(ebs_fault)
        FLAG(offboard_charger_fault) FLAG(charging) FLAG(batt_temp_high) FLAG(batt_soc_low) FLAG(handshake)
        FLAG(estop_request) NUMBER(front_axle_trq_request) NUMBER(rear_axle_trq_request) NUMBER(steer_request)
        NUMBER(steer_angle) NUMBER(fl_wheel_speed) NUMBER(fr_wheel_speed) NUMBER(rl_wheel_speed) NUMBER(rr_wheel_speed)
        NAME(ami, ADSDV_AMI_STATE) NAME(ebs, ADSDV_EBS_STATE) NAME(mission_status, ADSDV_MISSION_STATUS)
        NAME(direction_request, ADSDV_DIRECTION) NUMBER(status_silence_ms) NUMBER(drive_f_silence_ms)
        NUMBER(drive_r_silence_ms) NUMBER(steer_silence_ms) NUMBER(brake_silence_ms) NUMBER(hyd_press_f_req)
        NUMBER(hyd_press_r_req)
        const auto dt_ms = static_cast<std::uint32_t>(line.number("dt_ms"));
        check(adsdv_step(&machine_, &control_, &in, dt_ms, &out, nullptr, &error_), error_);
        return out;
    }

  private:
    adsdv_machine machine_;
    adsdv_control control_;
    adsdv_error error_;
};
} // namespace

int main() try {
    std::ios::sync_with_stdio(false);
    // What it says of itself: of a fixed cycle it would add "cycle_ms":10, and of a clock "clock":"wall".
    std::cout << R"({"outputs":["as_state","handshake","go_signal","shutdown_cause"]})" << std::endl;
    adsdv_edition edition;
    adsdv_error error;
    check(adsdv_edition_find("3.0", &edition, &error), error); // what all is about without a hello
    Vcu vcu(edition);
    for (std::string text; std::getline(std::cin, text);) {
        const Line line(text);
        if (line.text("op") == "hello") {
            // An edition that there is not is answered with the one that this VCU is of.
            const std::string version(line.text("edition"));
            if (adsdv_edition_find(version.c_str(), &edition, nullptr) == ADSDV_OK) vcu = Vcu(edition);
            std::cout << "{\"edition\":\"" << adsdv_edition_version(vcu.edition()) << "\"}\n";
        } else if (line.text("op") == "reset") {
            vcu = Vcu(vcu.edition());
            std::cout << "{}\n";
        } else {
            const adsdv_outputs out = vcu.step(line);
            // As much as this VCU shows; names may be given as their numbers, and flags as 1 and 0.
            std::cout << "{\"as_state\":" << +out.as_state << ",\"handshake\":" << +out.handshake
                      << ",\"go_signal\":" << +out.go_signal << ",\"shutdown_cause\":" << +out.shutdown_cause << "}\n";
        }
        // Whoever asks waits for the answer, unless more lines are there already.
        if (std::cin.rdbuf()->in_avail() == 0) std::cout.flush();
    }
} catch (const std::exception &error) {
    std::cerr << "adapter: " << error.what() << '\n';
    return 1;
}
