# cmake -DVALIDATOR=<glslangValidator> -DSHADERS=<folder of shaders without #include> -P validate_shaders.cmake
#
# Lets the reference compiler judge every program that the passes make, in all variants, without any driver.

cmake_minimum_required(VERSION 3.25)

if(NOT VALIDATOR)
  message("Shaders.PassGlslangValidator: Skipped\nneeds the program glslangValidator: install glslang-tools")
  return()
endif()

set(program_count 0)

# validate(NAME ... DEFINES -DX=1 ...): links the shaders of these names.
function(validate)
  cmake_parse_arguments(PARSE_ARGV 0 program "" "" "NAMES;DEFINES")
  set(files "")
  foreach(name IN LISTS program_NAMES)
    list(APPEND files "${SHADERS}/${name}.glsl")
  endforeach()
  execute_process(COMMAND "${VALIDATOR}" -l ${program_DEFINES} ${files} RESULT_VARIABLE status OUTPUT_VARIABLE output)
  if(NOT status EQUAL 0 OR output MATCHES "ERROR|WARNING")
    message(FATAL_ERROR "${program_NAMES} ${program_DEFINES}:\n${output}")
  endif()
  math(EXPR program_count "${program_count} + 1")
  set(program_count ${program_count} PARENT_SCOPE)
endfunction()

foreach(name IN ITEMS frame/check.comp mesh/classify.comp mesh/radius.comp mesh/transform.comp masks/receivers.comp
                      masks/cast.comp masks/resolve.comp
                      screen/alchemy/obscurance.comp
                      screen/bilateral.comp screen/receivers.comp screen/splat/surfaces.comp screen/splat/near.comp
                      screen/splat/resolve.comp screen/upsample.comp volumes/extend.comp volumes/resolve.comp)
  validate(NAMES ${name})
endforeach()
validate(NAMES frame/screen.vert masks/depth.frag)
validate(NAMES frame/screen.vert masks/fill.frag)
validate(NAMES frame/screen.vert volumes/receivers.frag)
validate(NAMES screen/splat/far.vert screen/splat/far.frag)
foreach(bitmask IN ITEMS 0 1)
  validate(NAMES screen/horizon/horizon.comp DEFINES -DLKAO_BITMASK=${bitmask})
endforeach()

foreach(count IN ITEMS 0 1)
  validate(NAMES screen/vao/tiles.comp DEFINES -DLKAO_COUNT=${count})
  validate(NAMES screen/vao/vao.comp DEFINES -DLKAO_COUNT=${count})
endforeach()

foreach(shape IN ITEMS "mesh/prism.vert" "mesh/billboard.vert" "mesh/point.vert;mesh/prism.geom"
                       "mesh/point.vert;mesh/billboard.geom")
  validate(NAMES ${shape} mesh/coverage.frag)
  foreach(layers IN ITEMS 1 8)
    foreach(variant IN ITEMS "0;0;0;0;0" "0;1;1;1;1" "1;0;0;1;0" "1;1;0;0;1" "1;0;1;0;0" "0;0;1;1;0")
      list(GET variant 0 must_may)
      list(GET variant 1 cube)
      list(GET variant 2 double)
      list(GET variant 3 atomics)
      list(GET variant 4 count)
      validate(NAMES ${shape} masks/accumulate.frag
               DEFINES -DLKAO_LAYERS=${layers} -DLKAO_MUST_MAY=${must_may} -DLKAO_CUBE_ADDRESSING=${cube}
                       -DLKAO_DOUBLE=${double} -DLKAO_ATOMICS=${atomics} -DLKAO_COUNT=${count})
    endforeach()
  endforeach()
endforeach()

foreach(shape IN ITEMS "volumes/volume.vert" "mesh/point.vert;volumes/volume.geom")
  foreach(kept IN ITEMS 0 1)
    foreach(two_horizons IN ITEMS 0 1)
      foreach(count IN ITEMS 0 1)
        validate(NAMES ${shape} volumes/accumulate.frag
                 DEFINES -DLKAO_KEPT=${kept} -DLKAO_TWO_HORIZONS=${two_horizons} -DLKAO_COUNT=${count})
      endforeach()
    endforeach()
  endforeach()
endforeach()

message(STATUS "${program_count} programs are valid")
