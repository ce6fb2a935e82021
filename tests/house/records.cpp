// The parser of the records, from which the shaders' record readers are generated.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "host/tools/record_layout.h"
#include "host/tools/record_readers.h"
#include "tests/house/tree.h"

namespace {

using namespace scree;

std::vector<host::Record> records_of(const std::string& text) {
    std::vector<host::Record> records;
    host::add_records(records, text, "records.h");
    return records;
}

std::string refusal_of(const std::string& text) {
    try {
        records_of(text);
    } catch (const host::RecordError& error) {
        return error.what();
    }
    return "none";
}

}  // namespace

TEST_CASE("house: every struct of records.h is a record, and all that are whole texels have a reader", "[house]") {
    std::vector<host::Record> records;
    std::vector<std::string> structs, found;
    for (const char* subject : {"body", "contact", "joint", "vehicle", "step"}) {  // as shaders/CMakeLists.txt has them
        const std::string path = std::string("shaders/physics/base/") + subject + "_records.h";
        const auto& files = house::code_files();
        const auto file = std::find_if(files.begin(), files.end(), [&](const house::SourceFile& f) { return f.path == path; });
        INFO(path);
        REQUIRE(file != files.end());
        const std::vector<house::Token> tokens = house::tokens_of(file->text);
        for (std::size_t i = 1; i < tokens.size(); ++i)
            if (tokens[i - 1].text == "struct") structs.push_back(tokens[i].text);
        host::add_records(records, file->text, path);
    }
    const std::string readers = host::readers_of(records, "records.h");
    for (const host::Record& record : records) {
        found.push_back(record.name);
        INFO(record.name);
        CHECK((readers.find("#define SCREE_READER_" + record.name + "(") != std::string::npos) ==
              (record.bytes == 4 || record.bytes == 8 || record.bytes % 16 == 0));
    }
    CHECK(found == structs);
    CHECK(found.size() > 20);
}

TEST_CASE("house: a record is laid out by std430, and its reader takes each member from its place", "[house]") {
    const std::vector<host::Record> records = records_of(
        "CONSTANT uint MOST = 2u;  // struct\n"
        "struct Inner { uvec4 all; };\n"
        "struct Outer {\n    vec3 a;  /* m */ float b;\n    uint c[MOST], d; int e;\n    Inner inner[2];\n};\n"
        "LAW float f(Outer o) { return o.b; }\n");
    REQUIRE(records.size() == 2);
    const host::Record& outer = records[1];
    CHECK(outer.bytes == 64);
    REQUIRE(outer.members.size() == 6);
    CHECK(outer.members[1].offset == 12);
    CHECK(outer.members[2].count == 2);
    CHECK(outer.members[3].offset == 24);
    CHECK(outer.members[5].offset == 32);
    CHECK(outer.members[5].stride == 16);
    const std::string readers = host::readers_of(records, "records.h");
    CHECK(readers.find("TEXEL(table, PLACE(4u, i, 3u))") != std::string::npos);
    CHECK(readers.find("Outer(uintBitsToFloat(t0.xyz), uintBitsToFloat(t0.w), uint[2](t1.x, t1.y), t1.z, int(t1.w), "
                       "Inner[2](Inner(t2), Inner(t3)))") != std::string::npos);
}

TEST_CASE("house: a record that C++ and GLSL would lay out differently is refused, with its place", "[house]") {
    CHECK(refusal_of("struct A { vec3 a; float b; };") == "none");
    CHECK(refusal_of("struct A {\n    float a;\n    vec4 b;\n};") ==
          "records.h:3: A.b is at byte 4 in C++ and at 16 in std430; fill the gap with scalars");
    CHECK(refusal_of("struct A {\n    vec3 a;\n};").find("A has 12 bytes in C++ and 16 in std430") != std::string::npos);
    CHECK(refusal_of("struct A { vec3 a[2]; };").find("an array of vec3 has gaps") != std::string::npos);
    CHECK(refusal_of("struct A { quat a; };") ==
          "records.h:1: 'quat' is no type that a record can have, nor a record before this one");
    CHECK(refusal_of("struct A { uint a[MANY]; };").find("'MANY' is no length") != std::string::npos);
    CHECK(refusal_of("struct A { uint a, a; };").find("two members a") != std::string::npos);
    CHECK(refusal_of("struct A {\n#ifdef B\n    uint a;\n#endif\n};") == "records.h:2: the preprocessor within a record");
    CHECK(refusal_of("struct A { uint a;").find("the file ends within a record") != std::string::npos);
    CHECK(refusal_of("struct A { };").find("A has no members") != std::string::npos);
}
