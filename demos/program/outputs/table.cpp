// Laying out tables.
#include "demos/program/outputs/table.h"

#include <algorithm>
#include <cctype>

namespace scree::demos {

namespace {

bool is_numeric_cell(const std::string& cell) {
    return !cell.empty() && (std::isdigit(static_cast<unsigned char>(cell[0])) || (cell[0] == '-' && cell.size() > 1));
}

}  // namespace

std::string table(const std::vector<Cells>& rows) {
    std::vector<std::size_t> width;
    std::vector<bool> right;
    for (const Cells& row : rows) {
        width.resize(std::max(width.size(), row.size()));
        right.resize(width.size(), rows.size() > 1);
        for (std::size_t i = 0; i < row.size(); ++i) {
            width[i] = std::max(width[i], row[i].size());
            if (&row != &rows.front() && !is_numeric_cell(row[i])) right[i] = false;
        }
    }
    std::string text;
    for (const Cells& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string space(width[i] - row[i].size(), ' ');
            line += (i ? "  " : "") + (right[i] ? space + row[i] : row[i] + space);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string markdown(const std::vector<Cells>& rows) {
    std::string text;
    for (const Cells& row : rows) {
        for (const std::string& cell : row) {
            text += "| ";
            for (const char c : cell) text += c == '|' ? "\\|" : std::string(1, c);
            text += " ";
        }
        text += "|\n";
        if (&row != &rows.front()) continue;
        for (std::size_t i = 0; i < row.size(); ++i) text += "|---";
        text += "|\n";
    }
    return text;
}

std::string csv_text(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == text.npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string csv(const std::vector<Cells>& rows) {
    std::string text;
    for (const Cells& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            text += (i ? "," : "") + csv_text(row[i]);
        }
        text += "\n";
    }
    return text;
}

Cells verdict_heading(Cells before) {
    for (const char* word : {"promise", "limit", "measured", ""}) before.emplace_back(word);
    return before;
}

Cells verdict(const Row& row, Cells before) {
    for (const std::string& cell : {row.what, row.promised, row.measured}) before.push_back(cell);
    before.emplace_back(row.pass ? "pass" : "MISS");
    return before;
}

}  // namespace scree::demos
