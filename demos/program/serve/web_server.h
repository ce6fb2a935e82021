// A small web server for scree serve: one page, and a WebSocket to each viewer. It knows nothing of worlds.
//
// It refuses requests without the token, for other hosts' names (a foreign page could have its own name lead here), and from
// pages of other origins. Everything but the page and the stream is 404.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace scree::demos {

struct ServerOptions {
    std::string host = "127.0.0.1";  // to listen on: an address, or "localhost"
    int port = 8080;                 // 0: any that is free
    std::size_t most_viewers = 8;
    std::string page;  // what it serves
};

struct Heard {
    enum class Kind { came, said, left } kind = Kind::came;
    std::uint64_t viewer = 0;
    std::string text{};  // said
};

class WebServer {
public:
    static constexpr std::size_t most_of_message = 4096;                // bytes from a viewer
    static constexpr std::size_t most_waiting = std::size_t{96} << 20;  // bytes that wait for a viewer

    // Listens. Throws WorkFailed, with the reason.
    explicit WebServer(ServerOptions options);
    ~WebServer();  // tells viewers that it ends
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    std::string address() const;  // to open, with the token
    bool is_open_to_others() const;
    // What came from viewers; waits for it until the time, at the longest.
    std::vector<Heard> hear(std::chrono::steady_clock::time_point until);

    using Message = std::shared_ptr<const std::string>;
    void send(std::uint64_t viewer, Message message, bool binary);
    // Says why, and closes.
    void dismiss(std::uint64_t viewer, const std::string& reason);

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
