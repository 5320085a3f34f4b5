// What a host includes.
#include <lkao/gl.h>
#include <lkao/lkao.h>

int main() { return LKAO_VERSION >= LKAO_MAKE_VERSION(0, 1, 0) ? 0 : 1; }
