// scree serve: a demo or a scene file in browsers, live.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <utility>

#include "demos/film/pages/page_recording.h"
#include "demos/film/pages/viewer_page.h"
#include "demos/film/style.h"
#include "demos/program/backend.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/options/output_check.h"
#include "demos/program/serve/live_session.h"

namespace scree::demos {

namespace {

// The page of recordings, with a word that it is live in place of one.
std::string live_page() {
    constexpr std::string_view place = "<!-- recording -->";
    std::string page(viewer_page());
    const std::size_t at = page.find(place);
    if (at == page.npos) throw UsageError("serve: " + PageRecording::why_not());
    page.replace(at, place.size(), "<script type=\"application/x-scree\" data-kind=\"live\"></script>");
    return page;
}

int serve(ServeOptions options) {
    require_writable_file("--report", options.report);
    options.server.page = live_page();
    const Backend machine = choose_machine(options.machine, Choice::fastest);
    if (!machine.remark.empty()) say("scree: {}\n", machine.remark);
    {
        WebServer server(options.server);
        LiveSession session(options, machine, server);
        at_work([&] {
            if (server.is_open_to_others())
                say("scree: --host {}: everyone who can reach this machine and knows the token may watch and drive; nothing is "
                    "encrypted\n",
                    options.server.host);
            fmt::print("{}\n", server.address());
            std::fflush(stdout);
            session.run();
            session.write_report();
        });
    }
    machine.require_valid();
    return is_interrupted() ? interrupted : done;
}

}  // namespace

void add_serve(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("serve", "Show a demo or a scene file live in a browser");
    auto options = std::make_shared<ServeOptions>();
    add_options(*command, options->scene);
    command->get_option("--steps")->description("End after this many steps.");
    command->get_option("--seconds")->description("End after this simulated time, s.");
    add_options(*command, options->machine);
    command->add_option("--port", options->server.port, "Port to listen on; 0: any that is free. Default: 8080.")
        ->check(CLI::Range(0, 65535))
        ->group("Server");
    command
        ->add_option("--host", options->server.host,
                     "Address to listen on. Default: 127.0.0.1, this machine alone; 0.0.0.0: every network it is on.")
        ->group("Server");
    command->add_option("--viewers", options->server.most_viewers, "Viewers at a time. Default: 8.")
        ->check(CLI::Range(1, 256))
        ->group("Server");
    command->add_option("--speed", options->speed, "Simulated seconds a second. Default: 1.")
        ->check(between(0.01, 100))
        ->group("Server");
    command->add_option("--fps", options->pictures.fps, "Frames a second at most. Default: 30.")
        ->check(between(1, 30))
        ->group("Server");
    command
        ->add_option("--color", options->pictures.color,
                     "Quantity shown by colour at first (words: scree run --help). Default: the scene's, mostly momentum.")
        ->check(one_of(color_words()))
        ->group("Server");
    command->add_option("--report", options->report, "JSON status file, rewritten every half second and at the end.")
        ->group("Server");
    command->footer(
        "Prints the address to open, with a token. The first viewer drives: pause, step, restart, grab, throw, explode, drive, "
        "other\n"
        "demos; others watch, and may take over. Time passes while somebody watches. Ctrl-C ends.\n\n"
        "Examples:\n  scree serve wall\n  scree serve pile --bodies 10k --port 9000\n"
        "  ssh -t -L 8080:127.0.0.1:8080 HOST scree serve cars    and open the address here");
    command->callback([options, &status] { status = serve(*options); });
}

}  // namespace scree::demos
