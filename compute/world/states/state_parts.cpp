// The tables of shares, piece by piece.
#include "compute/world/states/state_parts.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "compute/tables/lasting.h"
#include "compute/tables/table_layout.h"
#include "compute/world/states/byte_stream.h"
#include "compute/world/states/state_bytes.h"

namespace scree {

namespace {

// Rows of a piece: some megabytes of contacts.
constexpr std::uint32_t rows_of_piece = 8192;

// A contact by its place in the whole table: the row that owns it, and the id of its other body.
struct ContactPlace {
    std::uint32_t owner = 0, other = 0;
    auto operator<=>(const ContactPlace&) const = default;
};

template <class Record>
std::span<const std::byte> bytes_of_list(const std::vector<Record>& records) {
    return std::as_bytes(std::span(records));
}

}  // namespace

StateParts::StateParts(const State& share, Exchange& exchange) : state_(share), exchange_(exchange) {
    const physics::Parameters& p = share.fixed();
    rows_ = *share.first_part_id + (p.bodies - p.first_part);
    std::uint64_t own = 0;
    for_each_contact(0, rows_, [&](std::uint32_t, std::uint32_t) { ++own; });
    ByteWriter out;
    out.put(own);
    out.put(share.rows_bounce());
    for (const Bytes& one : exchange.all_gather(out.bytes())) {
        ByteReader in(one);
        contacts_ += in.take<std::uint64_t>();
        rows_bounce_ |= in.take<bool>();
    }
}

physics::Parameters StateParts::parameters() const {
    physics::Parameters p = state_.fixed();
    p.bodies = rows_;
    p.first_part = *state_.first_part_id;
    p.buckets = State::buckets_for(rows_);
    return p;
}

physics::Counts StateParts::counts() const {
    physics::Counts counts = state_.counted();
    counts.contacts = static_cast<std::uint32_t>(contacts_);
    return counts;
}

std::vector<std::pair<Table, std::size_t>> StateParts::stepped() const {
    return stepped_tables(rows_, contacts_, rows_bounce_ || state_.fixed().least_restitution > 0);
}

std::uint64_t StateParts::bytes() const {
    std::uint64_t all = 0;
    for (const auto& [table, count] : stepped()) all += count * record_bytes(table);
    return all;
}

void StateParts::put_tables(const Take& take) const {
    for (const auto& [table, count] : stepped()) {
        std::uint32_t before = 0;
        for (std::uint32_t first = 0; first < rows_; first += rows_of_piece) {
            const std::uint32_t last = std::min(first + rows_of_piece, rows_);
            if (table == Table::first_contacts)
                put_first_contacts(first, last, before, take);
            else if (is_of_rows(table))
                put_rows(table, first, last, take);
            else
                put_contacts(table, first, last, take);
        }
        if (table == Table::first_contacts && exchange_.rank() == 0) take(std::as_bytes(std::span(&before, 1)));
    }
}

std::vector<Bytes> StateParts::gathered(Bytes own) const {
    std::vector<Bytes> to(static_cast<std::size_t>(exchange_.ranks()));
    to[0] = std::move(own);
    return exchange_.all_to_all(to);
}

void StateParts::put_rows(Table table, std::uint32_t first, std::uint32_t last, const Take& take) const {
    const std::size_t bytes = record_bytes(table);
    const std::span<const std::byte> records = state_.raw(table);
    ByteWriter out;
    for (std::uint32_t whole = first; whole < last; ++whole) {
        const std::uint32_t row = state_.row_with(whole);
        // What does not move is on all ranks.
        if (row == physics::NONE || !(exchange_.rank() == 0 ? state_.is_stepped(row) : state_.is_owned(row))) continue;
        out.put(whole);
        if (table != Table::properties) {
            out.put_bytes(records.subspan(row * bytes, bytes));
        } else {
            physics::BodyProperties body = state_.properties[row];
            body.owner = state_.id_of(body.owner);
            out.put(body);
        }
    }
    const std::vector<Bytes> all = gathered(std::move(out.bytes()));
    if (exchange_.rank() != 0) return;
    std::vector<std::byte> piece((last - first) * bytes);
    std::uint32_t found = 0;
    for (const Bytes& one : all)
        for (ByteReader in(one); !in.at_end(); ++found) {
            const auto whole = in.take<std::uint32_t>();
            const std::span<const std::byte> record = in.take_bytes(bytes);
            std::copy(record.begin(), record.end(), piece.begin() + static_cast<std::ptrdiff_t>((whole - first) * bytes));
        }
    if (found != last - first) throw std::logic_error("ranks that save their shares lack a body, or have one twice");
    take(piece);
}

template <class Visit>
void StateParts::for_each_contact(std::uint32_t first, std::uint32_t last, const Visit& visit) const {
    for (std::uint32_t whole = first; whole < last; ++whole) {
        const std::uint32_t row = state_.row_with(whole);
        if (row == physics::NONE) continue;
        for (std::uint32_t k = state_.first_contacts[row]; k < state_.first_contacts[row + 1]; ++k)
            if (state_.owns_contact(state_.contacts[k])) visit(whole, k);
    }
}

void StateParts::put_first_contacts(std::uint32_t first, std::uint32_t last, std::uint32_t& before, const Take& take) const {
    ByteWriter out;
    for_each_contact(first, last, [&](std::uint32_t whole, std::uint32_t) { out.put(whole); });
    std::vector<std::uint32_t> starts(last - first);
    for (const Bytes& one : gathered(std::move(out.bytes())))
        for (ByteReader in(one); !in.at_end();) ++starts[in.take<std::uint32_t>() - first];
    if (exchange_.rank() != 0) return;
    for (std::uint32_t& start : starts) before += std::exchange(start, before);
    take(bytes_of_list(starts));
}

void StateParts::put_contacts(Table table, std::uint32_t first, std::uint32_t last, const Take& take) const {
    ByteWriter out;
    for_each_contact(first, last, [&](std::uint32_t whole, std::uint32_t k) {
        ContactRecords records = ContactRecords::of(state_, k);
        physics::Contact& contact = records.contacts;
        for (physics::uint* row : {&contact.a, &contact.b}) *row = state_.id_of(*row);
        out.put(ContactPlace{whole, contact.a == whole ? contact.b : contact.a});
#define SCREE_PUT(name) \
    if (table == Table::name) out.put(records.name);
        SCREE_LASTING_OF_CONTACTS(SCREE_PUT)
#undef SCREE_PUT
    });
    const std::size_t bytes = record_bytes(table);
    std::vector<std::pair<ContactPlace, std::span<const std::byte>>> piece;
    const std::vector<Bytes> all = gathered(std::move(out.bytes()));
    for (const Bytes& one : all)
        for (ByteReader in(one); !in.at_end();) {
            const auto place = in.take<ContactPlace>();
            piece.emplace_back(place, in.take_bytes(bytes));
        }
    std::sort(piece.begin(), piece.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    ByteWriter sorted;
    for (const auto& [place, record] : piece) sorted.put_bytes(record);
    if (!piece.empty()) take(sorted.bytes());
}

}  // namespace scree
