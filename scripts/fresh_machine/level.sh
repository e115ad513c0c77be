# shellcheck shell=bash disable=SC2154
# Processor levels that are lower than the machine's, to be read by a bash script.

# level_environment v2|v3|v4: settings NAME=VALUE, one a line, for programs to be compiled for this level and libraries
# that choose their code by the processor to choose for it. Nothing for no level.
level_environment() {
  local avx512="-AVX512F,-AVX512CD,-AVX512BW,-AVX512DQ,-AVX512VL"
  local numpy512="AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL AVX512_ICL"
  [ -z "$1" ] || echo "FSI_ARCH=x86-64-$1"
  case "$1" in
    v3)
      echo "OPENBLAS_CORETYPE=Haswell"
      echo "GLIBC_TUNABLES=glibc.cpu.hwcaps=$avx512"
      echo "NPY_DISABLE_CPU_FEATURES=$numpy512"
      ;;
    v2)
      echo "OPENBLAS_CORETYPE=Nehalem"
      echo "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,$avx512"
      echo "NPY_DISABLE_CPU_FEATURES=AVX F16C FMA3 AVX2 $numpy512"
      ;;
  esac
}

# registers_beyond LEVEL, of a disassembled program on standard input: how many lines use the registers that the level
# does not have, 512 bits wide and beyond v2 also 256.
registers_beyond() {
  local registers=zmm
  [ "$1" != v2 ] || registers='[yz]mm'
  grep -c "%$registers" || true
}
