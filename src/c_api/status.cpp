#include "lkao/c/status.h"

#include "c_api/handle_table.h"
#include "lkao/version.h"

const char* lkao_version(void) { return lkao::version(); }

size_t lkao_live_handle_count(void) { return lkao::c_api::live_count(); }
