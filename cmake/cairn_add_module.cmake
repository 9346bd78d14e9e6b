# cairn_export_only(TARGET LIST): it exports what exports/LIST.map says, and nothing else. Not with sanitizers, which need
# more.
function(cairn_export_only target list)
  if(NOT CAIRN_SANITIZERS)
    set(file ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/exports/${list}.map)
    target_link_options(${target} PRIVATE -Wl,--version-script=${file})
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${file})
  endif()
endfunction()

# cairn_add_module(NAME [CORE sources... | ROOMS rooms...] [LINK ...]): NAME.so from module.cpp. CORE gives the algorithm
# files, which become NAME_core, a static library that tests can link; LINK goes with them. ROOMS are object libraries
# cairn_ROOM that hold these files instead, a folder each.
#
# The same function makes Cairn's own modules and, installed with the CMake package, everybody else's.
# A module exports what exports/module.map names, whatever it is made of.
# The module lands in ${CMAKE_BINARY_DIR}/lib/cairn, for `cairn --plugins`; installed under the prefix
# of Cairn, the program finds it by itself.
function(cairn_add_module name)
  cmake_parse_arguments(arg "" "" "CORE;ROOMS;LINK" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "cairn_add_module(${name}): what is \"${arg_UNPARSED_ARGUMENTS}\"? It knows CORE, ROOMS and LINK")
  endif()
  set(own_options $<$<TARGET_EXISTS:cairn_private_options>:cairn_private_options>)
  add_library(${name} MODULE module.cpp)
  if(arg_CORE OR arg_ROOMS)
    list(TRANSFORM arg_ROOMS PREPEND cairn_)
    add_library(${name}_core STATIC ${arg_CORE})
    target_link_libraries(${name}_core PUBLIC cairn::framework PRIVATE ${arg_ROOMS} ${own_options} ${arg_LINK})
    target_link_libraries(${name} PRIVATE ${name}_core ${own_options})
    set_target_properties(${name}_core ${arg_ROOMS} PROPERTIES
                          CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON
                          LINKER_LANGUAGE CXX)
  else()
    target_link_libraries(${name} PRIVATE cairn::framework ${own_options} ${arg_LINK})
  endif()
  if(NOT CAIRN_SANITIZERS)  # whose functions are in the program
    target_link_options(${name} PRIVATE -Wl,--no-undefined)  # found when linking, not when loading
    cairn_export_only(${name} module)
  endif()
  # One path for both trees: one that is changed when it is installed ends in an empty element until then, which is the
  # current folder.
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
                                           LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/cairn
                                           INSTALL_RPATH "$ORIGIN/.." BUILD_WITH_INSTALL_RPATH ON)
  if(NOT TARGET cairn_private_options)  # of others: Cairn's libraries are where it was installed
    set_target_properties(${name} PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
  endif()
  install(TARGETS ${name} LIBRARY DESTINATION lib/cairn)
  set_property(GLOBAL APPEND PROPERTY CAIRN_MODULES ${name})
endfunction()
