# Makes NAME.tar.gz: the program, libscree with scree.h, and the libraries they need, for Linux machines on which nothing can be
# installed.
# cmake -DBUILD=FOLDER -DNAME=NAME [-DLOADER=libvulkan.so.1] -P bundle.cmake
#
# lib/scree/scree and libscree find the libraries beside them by their run path. Those that GPU drivers load as well, and the Vulkan loader, lie in
# a folder for machines that lack them (launcher.sh). The C library and drivers are the machine's.
set(stage ${BUILD}/bundle/${NAME})
set(home ${stage}/lib/scree)
file(REMOVE_RECURSE ${stage})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component program --prefix ${stage} --strip
                COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(MAKE_DIRECTORY ${home})
file(RENAME ${stage}/bin/scree ${home}/scree)
file(INSTALL ${CMAKE_CURRENT_LIST_DIR}/launcher.sh DESTINATION ${stage}/bin USE_SOURCE_PERMISSIONS RENAME scree)

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component library --prefix ${stage}/library --strip
                COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(GLOB_RECURSE libscree ${stage}/library/*/libscree.so.0)
file(INSTALL ${libscree} DESTINATION ${home} FOLLOW_SYMLINK_CHAIN)
file(REMOVE_RECURSE ${stage}/library)
file(CREATE_LINK libscree.so.0 ${home}/libscree.so SYMBOLIC)
file(INSTALL ${CMAKE_CURRENT_LIST_DIR}/../c/scree.h DESTINATION ${stage}/include/scree)

file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${home}/scree LIBRARIES ${home}/libscree.so.0 RESOLVED_DEPENDENCIES_VAR libraries UNRESOLVED_DEPENDENCIES_VAR missing
     PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|resolv)\\.so")
if(missing)
    message(FATAL_ERROR "the bundle lacks ${missing}, which were not found on this machine")
endif()
foreach(library ${libraries})
    if(library MATCHES "/lib(stdc\\+\\+|gcc_s|z|X11|xcb|Xau|Xdmcp|bsd|md)\\.so[^/]*$")
        file(INSTALL ${library} DESTINATION ${home}/fallback FOLLOW_SYMLINK_CHAIN)
    else()
        file(INSTALL ${library} DESTINATION ${home} FOLLOW_SYMLINK_CHAIN)
    endif()
endforeach()
if(LOADER)
    file(INSTALL ${LOADER} DESTINATION ${home}/fallback FOLLOW_SYMLINK_CHAIN)
endif()
file(INSTALL ${CMAKE_CURRENT_LIST_DIR}/README.txt ${CMAKE_CURRENT_LIST_DIR}/../../LICENSE DESTINATION ${stage})

execute_process(COMMAND ${CMAKE_COMMAND} -E tar czf ${BUILD}/${NAME}.tar.gz ${NAME}
                WORKING_DIRECTORY ${BUILD}/bundle COMMAND_ERROR_IS_FATAL ANY)
file(SIZE ${BUILD}/${NAME}.tar.gz bytes)
math(EXPR megabytes "(${bytes} + 999999) / 1000000")
message(STATUS "${BUILD}/${NAME}.tar.gz: ${megabytes} MB")
