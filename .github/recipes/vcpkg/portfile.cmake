# Draft; see ../README.md.
vcpkg_download_distfile(archive URLS "@SOURCE@" FILENAME scree-@VERSION@.tar.gz SHA512 @SHA512@)
vcpkg_extract_source_archive(source ARCHIVE "${archive}")
# Of pictures.
vcpkg_download_distfile(fonts URLS "https://github.com/dejavu-fonts/dejavu-fonts/releases/download/version_2_37/dejavu-fonts-ttf-2.37.tar.bz2"
    FILENAME dejavu-fonts-ttf-2.37.tar.bz2 SHA512 @FONT_SHA512@)
vcpkg_extract_source_archive(fonts_folder ARCHIVE "${fonts}")
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES vulkan SCREE_VULKAN)
# The C library is made with the program's commands.
vcpkg_cmake_configure(SOURCE_PATH "${source}" OPTIONS ${features} -DSCREE_PROGRAM=ON -DSCREE_WINDOW=OFF -DSCREE_PYTHON=OFF
    -DSCREE_MPI=OFF -DSCREE_TESTS=OFF "-DSCREE_FONT=${fonts_folder}/ttf/DejaVuSans.ttf")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/scree)
vcpkg_fixup_pkgconfig()
vcpkg_copy_tools(TOOL_NAMES scree AUTO_CLEAN)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${source}/LICENSE")
