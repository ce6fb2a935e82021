// Loading the module of MPI, and ending together.
#include "demos/program/ranks.h"

#include <chrono>
#include <filesystem>
#include <thread>

#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "host/system/libraries.h"
#include "host/system/machine.h"

namespace scree::demos {

namespace {

constexpr const char* module_name = "libscree_mpi.so";

void* load_module() {
    if (!host::has_modules) throw UsageError("--distributed: one world on several processes is for Linux; leave the option out");
    std::error_code failed;
    const std::filesystem::path folder = host::own_program().parent_path();
    for (const char* at : {".", "../lib/scree", "../lib/x86_64-linux-gnu/scree", "../lib/aarch64-linux-gnu/scree"}) {
        const std::filesystem::path file = folder / at / module_name;
        if (!std::filesystem::exists(file, failed)) continue;
        std::string reason;
        if (void* module = host::load_module(file, reason)) return module;
        throw UsageError(fmt::format("--distributed: {}", reason));
    }
    throw UsageError(fmt::format(
        "--distributed: there is no {} beside this scree; build it where MPI is (package libopenmpi-dev, -DSCREE_MPI=ON)",
        module_name));
}

}  // namespace

std::shared_ptr<Exchange> join_ranks(Neighbours& neighbours) {
    host::give_memory_back();
    void* const join = host::function_of(load_module(), module_function);
    if (!join) throw UsageError(fmt::format("--distributed: {} is of another scree", module_name));
    return std::shared_ptr<Exchange>(reinterpret_cast<JoinRanks*>(join)(&neighbours));
}

int on_a_rank(Exchange& exchange, const std::function<int()>& work) {
    const auto end = [&](const std::string& reason, int status) {
        // What every rank finds wrong the first one tells, and ends the others.
        if (exchange.rank() > 0 && status == wrong_usage) std::this_thread::sleep_for(std::chrono::seconds(3));
        if (exchange.rank() > 0)
            say("scree: rank {}: {}\n", exchange.rank(), printable(reason));
        else
            say("scree: {}\n", printable(reason));
        exchange.end_all(status);
    };
    try {
        return work();
    } catch (const UsageError& error) {
        end(error.what(), wrong_usage);
    } catch (const WorkFailed& error) {
        end(error.what(), promise_missed);
    } catch (const std::bad_alloc&) {
        end("beyond memory: the scene does not fit; ask for fewer --bodies", promise_missed);
    } catch (const std::exception& error) {
        end(error.what(), wrong_usage);
    }
    return promise_missed;
}

}  // namespace scree::demos
