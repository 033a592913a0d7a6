#include "attack.h"
void _start(void) { attack(); }
int __libc_start_main(void) { attack(); return 0; }
void _init(void) { attack(); }
void _fini(void) { attack(); }
void _dl_relocate_static_pie(void) { attack(); }
void __libc_csu_init(void) { attack(); }
#include "body.h"
