# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Writes the words of a SPIR-V file into a C++ header as a string literal, which compilers read ten times as fast as an array:
# cmake -DINPUT=… -DOUTPUT=… -DNAME=… [-DALL_NAMES=ON] -P EmbedSpirv.cmake
# Of the names (OpName, OpMemberName) only those of bindings, of specialisation constants, and of structures and their
# members stay. Reflection reads them, and tools show them. Mesa 22.3 refuses copies between two structures of which only
# one has a name, so names of structures without a memory layout stay too. ALL_NAMES keeps all names.
# spirv-opt cannot do this: it strips all names (--strip-debug) or none.
cmake_minimum_required(VERSION 3.25)

# Numbers of the SPIR-V specification, as in spirv.hpp.
set(OpName 5)
set(OpMemberName 6)
set(OpTypeVoid 19)
set(OpTypeForwardPointer 39)
set(OpDecorate 71)
set(SpecId_or_Binding "^(01|21)000000$")  # the decorations 1 and 33

# Finds the names, which precede the first type, and the ids that keep theirs. An item of names: first byte, end byte, id.
set(names "")
set(named_ids "")
set(at 20)  # bytes of the header
file(SIZE ${INPUT} size)
while(at LESS size AND NOT ALL_NAMES)
  file(READ ${INPUT} start OFFSET ${at} LIMIT 12 HEX)
  # SPIR-V is little-endian: opcode, number of words, then the first two operands.
  string(REGEX REPLACE "^(..)(..)(..)(..)(........)?(........)?$" "0x\\2\\1;0x\\4\\3;\\5;\\6" fields "${start}")
  list(POP_FRONT fields opcode words id second)
  math(EXPR opcode "${opcode}")
  math(EXPR end "${at} + 4 * ${words}")
  if(opcode GREATER_EQUAL ${OpTypeVoid} AND opcode LESS_EQUAL ${OpTypeForwardPointer})
    break()  # the first type
  elseif(opcode EQUAL ${OpName} OR opcode EQUAL ${OpMemberName})
    list(APPEND names "${at} ${end} ${id}")
    if(opcode EQUAL ${OpMemberName})
      list(APPEND named_ids ${id})  # a structure
    endif()
  elseif(opcode EQUAL ${OpDecorate} AND second MATCHES "${SpecId_or_Binding}")
    list(APPEND named_ids ${id})
  endif()
  set(at ${end})
endwhile()

set(bytes "")
set(from 0)
foreach(name IN LISTS names)
  string(REPLACE " " ";" name "${name}")
  list(POP_FRONT name first end id)
  if(NOT id IN_LIST named_ids)
    if(first GREATER from)
      math(EXPR count "${first} - ${from}")
      file(READ ${INPUT} part OFFSET ${from} LIMIT ${count} HEX)
      string(APPEND bytes "${part}")
    endif()
    set(from ${end})
  endif()
endforeach()
file(READ ${INPUT} part OFFSET ${from} HEX)
string(APPEND bytes "${part}")
# The last byte of each four is the most significant.
string(REGEX REPLACE "(..)(..)(..)(..)" "\\\\x\\4\\3\\2\\1" words "${bytes}")
file(WRITE ${OUTPUT} "#pragma once\nconst char32_t ${NAME}[] = U\"${words}\";\n")
