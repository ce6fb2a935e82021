# Writes the public headers as users see them, under PLACE/scree: they name each other "scree/compute/scene.h", so that PLACE alone
# is a program's include folder, which may have folders compute and host of its own. In the tree they are "compute/scene.h".
#
# Takes `root`, `place`, the list `public_headers`, and `moved_headers` with forwarders where one of them has been before: "OLD NEW".
cmake_policy(VERSION 3.25)  # also when it runs in an installation
file(REMOVE_RECURSE ${place}/scree)
foreach(header ${public_headers})
    file(READ ${root}/${header} text)
    string(REGEX REPLACE "#include \"(compute|host)/" "#include \"scree/\\1/" text "${text}")
    file(WRITE ${place}/scree/${header} "${text}")
endforeach()
foreach(moved ${moved_headers})
    if(moved MATCHES "^([^ ]+) (.+)$" AND CMAKE_MATCH_2 IN_LIST public_headers)
        file(WRITE ${place}/scree/${CMAKE_MATCH_1}
             "// Deprecated: include <scree/${CMAKE_MATCH_2}>.\n#pragma once\n#include \"scree/${CMAKE_MATCH_2}\"\n")
    endif()
endforeach()
