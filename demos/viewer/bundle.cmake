# Makes the viewer one page, and that page a C++ source: cmake -DESBUILD=FILE -DSOURCE=FOLDER -DWORK=FOLDER -DOUTPUT=FILE.cpp -P.
# Without ESBUILD the page is empty.
set(bytes "")
set(length 0)
if(ESBUILD)
    file(MAKE_DIRECTORY ${WORK})
    foreach(made main.js style.css)
        execute_process(COMMAND ${ESBUILD} ${SOURCE}/${made} --bundle --minify --charset=utf8 --log-level=warning --target=es2020 --loader:.h=text
                                --outfile=${WORK}/${made} RESULT_VARIABLE failed)
        if(failed)
            message(FATAL_ERROR "esbuild does not bundle ${SOURCE}/${made}")
        endif()
    endforeach()
    # As bytes, since CMake's lists and escapes would change the text.
    function(hex_of file result)
        file(READ ${file} hex HEX)
        set(${result} "${hex}" PARENT_SCOPE)
    endfunction()
    hex_of(${SOURCE}/page.html page)
    file(GLOB parts ${SOURCE}/parts/*.html)
    foreach(part ${parts})
        get_filename_component(name ${part} NAME_WE)
        string(HEX "<!-- part: ${name} -->\n" mark)
        hex_of(${part} text)
        string(REPLACE "${mark}" "${text}" page "${page}")
    endforeach()
    hex_of(${WORK}/main.js script)
    hex_of(${WORK}/style.css style)
    # "/*script*/" and "/*style*/".
    string(REPLACE "2f2a7363726970742a2f" "${script}" page "${page}")
    string(REPLACE "2f2a7374796c652a2f" "${style}" page "${page}")
    string(LENGTH "${page}" length)
    math(EXPR length "${length} / 2")
    string(REGEX REPLACE "(................................................................)" "\\1\n" page "${page}")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${page}")
endif()
set(text "// The page of the viewer. Made by demos/viewer/bundle.cmake.
#include \"demos/film/pages/viewer_page.h\"

namespace scree::demos {
namespace {
constexpr unsigned char page[] = {
${bytes}0};
}
std::string_view viewer_page() {
    return {reinterpret_cast<const char*>(page), ${length}};
}
}  // namespace scree::demos
")
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "${text}" @ONLY)
