// The web server of scree serve, by Boost.Beast: one thread for all connections.
#include "demos/program/serve/web_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <string_view>
#include <thread>
#include <utility>

#include "demos/program/exit_status.h"

namespace scree::demos {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;
using Socket = websocket::stream<beast::tcp_stream>;

constexpr std::size_t most_connections = 64;  // beside viewers
constexpr std::size_t most_heard = 4096;      // messages of a viewer that wait to be heard, as while a scene is read
constexpr std::size_t most_of_header = 8192;  // bytes
constexpr auto patience = std::chrono::seconds(10);
constexpr auto farewell = std::chrono::seconds(2);

std::string_view view_of(beast::string_view text) {
    return {text.data(), text.size()};
}

std::string random_token() {
    std::random_device source("/dev/urandom");
    std::string token;
    for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", source() & 0xFFFFFFFFu);
    return token;
}

// Takes as long for every wrong word of the right length.
bool is_token(std::string_view word, std::string_view token) {
    if (word.size() != token.size()) return false;
    unsigned differs = 0;
    for (std::size_t i = 0; i < token.size(); ++i)
        differs |= static_cast<unsigned>(static_cast<unsigned char>(word[i]) ^ static_cast<unsigned char>(token[i]));
    return differs == 0;
}

std::string_view token_in(std::string_view query) {
    while (!query.empty()) {
        const std::size_t end = std::min(query.find('&'), query.size());
        if (query.substr(0, end).starts_with("token=")) return query.substr(6, end - 6);
        query.remove_prefix(std::min(end + 1, query.size()));
    }
    return {};
}

// The name of "name:port", "[::1]:port"; empty where that is none. Lower case.
std::string name_of(std::string_view host) {
    std::string_view name = host;
    if (name.starts_with('[')) {
        const std::size_t end = name.find(']');
        if (end == name.npos) return "";
        name = name.substr(1, end - 1);
    } else {
        name = name.substr(0, name.find(':'));
    }
    std::string lower;
    for (const char c : name) {
        const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
                          c == '_' || c == ':';
        if (!fits) return "";
        lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return lower;
}
// Whether nothing but a port, or nothing, follows the name.
bool has_plain_port(std::string_view host) {
    const std::size_t end = host.find(']');
    const std::string_view rest = host.substr(end != host.npos ? end + 1 : std::min(host.find(':'), host.size()));
    return rest.empty() || (rest.size() > 1 && rest.size() < 7 && rest[0] == ':' &&
                            std::all_of(rest.begin() + 1, rest.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

using Message = WebServer::Message;
struct Outgoing {
    Message message;
    bool binary = false;
};

}  // namespace

struct WebServer::Impl {
    class Viewer;
    class Request;

    ServerOptions options;
    std::string token = random_token();
    std::size_t joining = 0;   // handshakes
    std::size_t requests = 0;  // connections that have no answer yet
    asio::io_context context{1};
    // Keeps the thread at work after the acceptor has closed: the end waits for its answers.
    asio::executor_work_guard<asio::io_context::executor_type> staying{context.get_executor()};
    tcp::acceptor acceptor{context};
    bool on_loopback = true;
    std::string own_name{};  // of this machine
    std::string listening{};
    std::map<std::uint64_t, std::shared_ptr<Viewer>> viewers{};
    std::uint64_t last_viewer = 0;
    bool ending = false;

    std::mutex mutex{};
    std::condition_variable heard_something{};
    std::vector<Heard> heard{};
    std::map<std::uint64_t, std::size_t> unheard{};  // messages in it, by viewer

    std::thread thread{};

    explicit Impl(ServerOptions chosen) : options(std::move(chosen)) {
        listen();
        accept();
        thread = std::thread([this] { work(); });
    }
    void work() {
        for (;;) {
            try {
                context.run();
                return;
            } catch (const std::exception&) {  // of one connection, which is gone with it
            }
        }
    }
    void listen();
    void accept();
    bool knows_host(std::string_view host) const;
    bool knows_origin(std::string_view origin, std::string_view host) const;
    // False: too much waits already.
    bool tell(Heard what) {
        const std::lock_guard lock(mutex);
        if (what.kind == Heard::Kind::said && ++unheard[what.viewer] > most_heard) return false;
        heard.push_back(std::move(what));
        heard_something.notify_one();
        return true;
    }
    void take_viewer(beast::tcp_stream&& stream, http::request<http::empty_body> request);
};

// A viewer's WebSocket. All of it runs in the server's thread.
class WebServer::Impl::Viewer : public std::enable_shared_from_this<Viewer> {
public:
    Viewer(Impl& server, beast::tcp_stream&& stream, std::uint64_t number)
        : server_(server), socket_(std::move(stream)), timer_(server.context), number_(number) {}

    void begin(http::request<http::empty_body> request) {
        request_ = std::move(request);
        beast::get_lowest_layer(socket_).expires_never();
        websocket::stream_base::timeout timeout{};
        timeout.handshake_timeout = patience;
        timeout.idle_timeout = std::chrono::seconds(60);
        timeout.keep_alive_pings = true;
        socket_.set_option(timeout);
        socket_.read_message_max(most_of_message);
        socket_.async_accept(request_, [self = shared_from_this()](error_code error) {
            --self->server_.joining;
            if (error || self->server_.ending) return;
            self->server_.viewers[self->number_] = self;
            self->joined_ = true;
            self->server_.tell({Heard::Kind::came, self->number_});
            self->read();
        });
    }

    void send(Outgoing message) {
        if (closing_) return;
        waiting_ += message.message->size();
        queue_.push_back(std::move(message));
        if (waiting_ > most_waiting) return dismiss("this viewer cannot keep up: too much waits for it");
        if (!writing_) write();
    }

    void dismiss(const std::string& reason) {
        if (closing_) return;
        closing_ = true;
        while (queue_.size() > (writing_ ? 1u : 0u)) queue_.pop_back();
        const nlohmann::json bye{{"type", "bye"}, {"reason", reason}};
        queue_.push_back({std::make_shared<const std::string>(bye.dump()), false});
        if (!writing_) write();
        timer_.expires_after(farewell);
        timer_.async_wait([self = shared_from_this()](error_code error) {
            if (!error) beast::get_lowest_layer(self->socket_).close();
        });
    }

private:
    void read() {
        socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
            if (error) return self->leave();
            if (!self->socket_.got_text()) return self->drop("messages are JSON texts");
            std::string text = beast::buffers_to_string(self->buffer_.data());
            self->buffer_.consume(self->buffer_.size());
            if (!self->closing_ && !self->server_.tell({Heard::Kind::said, self->number_, std::move(text)}))
                self->dismiss("too many messages");
            self->read();
        });
    }
    void drop(const std::string& reason) {
        dismiss(reason);
        buffer_.consume(buffer_.size());
        read();
    }
    void write() {
        if (queue_.empty()) {
            if (closing_)
                socket_.async_close(websocket::close_code::policy_error,
                                    [self = shared_from_this()](error_code) { self->leave(); });
            return;
        }
        writing_ = true;
        socket_.text(!queue_.front().binary);
        socket_.async_write(asio::buffer(*queue_.front().message), [self = shared_from_this()](error_code error, std::size_t) {
            self->writing_ = false;
            if (error || !self->joined_) return self->leave();
            self->waiting_ -= std::min(self->waiting_, self->queue_.front().message->size());
            self->queue_.pop_front();
            self->write();
        });
    }
    void leave() {
        closing_ = true;
        if (!std::exchange(joined_, false)) return;
        timer_.cancel();
        while (queue_.size() > (writing_ ? 1u : 0u)) queue_.pop_back();  // what is being written must stay
        beast::get_lowest_layer(socket_).close();
        server_.viewers.erase(number_);
        server_.tell({Heard::Kind::left, number_});
    }

    Impl& server_;
    Socket socket_;
    asio::steady_timer timer_;
    std::uint64_t number_;
    http::request<http::empty_body> request_{};
    beast::flat_static_buffer<most_of_message + 256> buffer_{};
    std::deque<Outgoing> queue_{};
    std::size_t waiting_ = 0;  // bytes of the queue
    bool writing_ = false, closing_ = false, joined_ = false;
};

// A connection until it has its answer, or becomes a viewer.
class WebServer::Impl::Request : public std::enable_shared_from_this<Request> {
public:
    Request(Impl& server, tcp::socket&& socket) : server_(server), stream_(std::move(socket)) { ++server_.requests; }
    ~Request() { --server_.requests; }
    Request(const Request&) = delete;
    Request& operator=(const Request&) = delete;

    void begin() {
        parser_.header_limit(most_of_header);
        parser_.body_limit(0);
        stream_.expires_after(patience);
        http::async_read_header(stream_, buffer_, parser_, [self = shared_from_this()](error_code error, std::size_t) {
            if (error == http::error::header_limit)
                return self->answer(http::status::request_header_fields_too_large, "The header is too long.");
            if (error && error.category() == beast::http::make_error_code(http::error::bad_method).category())
                return self->answer(http::status::bad_request, "This is no request that scree serve knows.");
            if (!error) self->decide();
        });
    }

private:
    void decide() {
        const auto& request = parser_.get();
        const std::string_view host = view_of(request[http::field::host]), target = view_of(request.target());
        const std::string_view path = target.substr(0, target.find('?'));
        const std::string_view query = path.size() < target.size() ? target.substr(path.size() + 1) : std::string_view{};
        if (request.count(http::field::host) != 1 || !server_.knows_host(host))
            return answer(http::status::forbidden, "This address is none of this server's; open the one that it printed.");
        if (path != "/" && path != "/stream") return answer(http::status::not_found, "There is nothing here.");
        const bool streams = path == "/stream";
        if (request.method() != http::verb::get && !(request.method() == http::verb::head && !streams))
            return answer(http::status::method_not_allowed, "Only GET is understood.");
        if (!is_token(token_in(query), server_.token))
            return answer(http::status::forbidden, "The address lacks the token; open the one that scree serve printed.");
        const bool has_origin = request.count(http::field::origin) > 0;
        if (has_origin &&
            (request.count(http::field::origin) != 1 || !server_.knows_origin(view_of(request[http::field::origin]), host)))
            return answer(http::status::forbidden, "Pages of other origins are refused.");
        if (!streams) return answer_page(std::string(host), request.method() == http::verb::head);
        if (!websocket::is_upgrade(request)) return answer(http::status::upgrade_required, "This is a WebSocket.");
        if (server_.viewers.size() + server_.joining >= server_.options.most_viewers)
            return answer(http::status::service_unavailable, "There are as many viewers as are allowed (--viewers).");
        stream_.expires_never();
        server_.take_viewer(std::move(stream_), parser_.release());
    }

    void answer_page(const std::string& host, bool head) {
        std::string page = server_.options.page;
        // The page may speak to its own server and to nobody else.
        constexpr std::string_view policy = "default-src 'none';";
        if (const std::size_t at = page.find(policy); at != page.npos)
            page.insert(at + policy.size(), " connect-src 'self' ws://" + host + ";");
        reply(http::status::ok, "text/html; charset=utf-8", std::move(page), head);
    }
    void answer(http::status status, const std::string& text) { reply(status, "text/plain; charset=utf-8", text + "\n", false); }
    void reply(http::status status, const char* type, std::string body, bool head) {
        response_.result(status);
        response_.version(11);
        response_.set(http::field::content_type, type);
        response_.set(http::field::cache_control, "no-store");
        response_.set("Referrer-Policy", "no-referrer");
        response_.set("X-Frame-Options", "DENY");
        response_.set("X-Content-Type-Options", "nosniff");
        response_.set("Cross-Origin-Resource-Policy", "same-origin");
        response_.set("Cross-Origin-Opener-Policy", "same-origin");
        response_.keep_alive(false);
        response_.content_length(body.size());
        if (!head) response_.body() = std::move(body);
        stream_.expires_after(std::chrono::seconds(60));
        serializer_.emplace(response_);
        const auto end = [self = shared_from_this()](error_code, std::size_t) {
            error_code ignored;
            self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
            self->stream_.expires_after(farewell);
            self->drain();
        };
        if (head)
            http::async_write_header(stream_, *serializer_, end);
        else
            http::async_write(stream_, *serializer_, end);
    }
    // What the other side still sends is read and forgotten, a little: a connection that is closed before loses the answer.
    void drain() {
        stream_.async_read_some(asio::buffer(rest_), [self = shared_from_this()](error_code error, std::size_t count) {
            self->drained_ += count;
            if (!error && self->drained_ < (std::size_t{1} << 20)) self->drain();
        });
    }

    Impl& server_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_{most_of_header + 1024};
    http::request_parser<http::empty_body> parser_{};
    http::response<http::string_body> response_{};
    std::optional<http::response_serializer<http::string_body>> serializer_{};
    std::array<char, 4096> rest_{};
    std::size_t drained_ = 0;
};

void WebServer::Impl::take_viewer(beast::tcp_stream&& stream, http::request<http::empty_body> request) {
    error_code ignored;
    stream.socket().set_option(tcp::no_delay(true), ignored);
    ++joining;
    std::make_shared<Viewer>(*this, std::move(stream), ++last_viewer)->begin(std::move(request));
}

void WebServer::Impl::listen() {
    error_code error;
    const auto require = [&](const char* what) {
        if (error)
            throw WorkFailed(fmt::format("--host {} --port {}: {}: {}", options.host, options.port, what, error.message()));
    };
    const asio::ip::address address = asio::ip::make_address(options.host == "localhost" ? "127.0.0.1" : options.host, error);
    require("this is no address of this machine, such as 127.0.0.1, ::1 or 0.0.0.0");
    on_loopback = address.is_loopback();
    own_name = asio::ip::host_name(error);
    if (error) own_name.clear();
    const tcp::endpoint place(address, static_cast<unsigned short>(options.port));
    error = {};
    acceptor.open(place.protocol(), error);
    require("it cannot be opened");
    acceptor.set_option(asio::socket_base::reuse_address(true), error);
    acceptor.bind(place, error);
    require("it cannot be served");
    acceptor.listen(64, error);
    require("it cannot be served");
    const bool any = address.is_unspecified();
    const std::string shown = any               ? (own_name.empty() ? "localhost" : own_name)
                              : address.is_v6() ? "[" + address.to_string() + "]"
                                                : address.to_string();
    listening = fmt::format("http://{}:{}/?token={}", shown, acceptor.local_endpoint().port(), token);
}

void WebServer::Impl::accept() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
        if (ending) return;
        if (error) {  // such as too many open files: try again in a while
            auto pause = std::make_shared<asio::steady_timer>(context, std::chrono::milliseconds(100));
            return pause->async_wait([this, pause](error_code) {
                if (!ending) accept();
            });
        }
        accept();
        if (requests < most_connections) std::make_shared<Request>(*this, std::move(socket))->begin();
    });
}

// Names of this machine alone: another name may be a stranger's that leads here.
bool WebServer::Impl::knows_host(std::string_view host) const {
    const std::string name = name_of(host);
    if (name.empty() || !has_plain_port(host)) return false;
    if (name == "localhost") return true;
    error_code error;
    const asio::ip::address address = asio::ip::make_address(name, error);
    if (!error) return address.is_loopback() || !on_loopback;
    return !on_loopback && !own_name.empty() && (name == name_of(own_name) || name == name_of(own_name) + ".local");
}

bool WebServer::Impl::knows_origin(std::string_view origin, std::string_view host) const {
    constexpr std::string_view scheme = "http://";
    return origin.starts_with(scheme) && origin.substr(scheme.size()) == host;
}

WebServer::WebServer(ServerOptions options) : interior_(std::make_unique<Impl>(std::move(options))) {}

WebServer::~WebServer() {
    Impl& in = *interior_;
    asio::post(in.context, [&in] {
        in.ending = true;
        error_code ignored;
        in.acceptor.close(ignored);
        const auto viewers = in.viewers;
        for (const auto& [number, viewer] : viewers) viewer->dismiss("scree serve has ended");
    });
    // A moment for farewells.
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
    for (std::size_t left = 1; left > 0 && std::chrono::steady_clock::now() < until;) {
        std::mutex mutex;
        std::condition_variable told;
        bool done = false;
        asio::post(in.context, [&] {
            const std::lock_guard lock(mutex);
            left = in.viewers.size();
            done = true;
            told.notify_one();
        });
        std::unique_lock lock(mutex);
        told.wait(lock, [&] { return done; });
        if (left > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    in.context.stop();
    in.thread.join();
    in.viewers.clear();
}

std::string WebServer::address() const {
    return interior_->listening;
}

bool WebServer::is_open_to_others() const {
    return !interior_->on_loopback;
}

std::vector<Heard> WebServer::hear(std::chrono::steady_clock::time_point until) {
    std::unique_lock lock(interior_->mutex);
    interior_->heard_something.wait_until(lock, until, [this] { return !interior_->heard.empty(); });
    interior_->unheard.clear();
    return std::exchange(interior_->heard, {});
}

void WebServer::send(std::uint64_t viewer, Message message, bool binary) {
    asio::post(interior_->context, [in = interior_.get(), viewer, message = std::move(message), binary] {
        const auto found = in->viewers.find(viewer);
        if (found != in->viewers.end()) std::shared_ptr<Impl::Viewer>(found->second)->send({message, binary});
    });
}

void WebServer::dismiss(std::uint64_t viewer, const std::string& reason) {
    asio::post(interior_->context, [in = interior_.get(), viewer, reason] {
        const auto found = in->viewers.find(viewer);
        if (found != in->viewers.end()) std::shared_ptr<Impl::Viewer>(found->second)->dismiss(reason);
    });
}

}  // namespace scree::demos
