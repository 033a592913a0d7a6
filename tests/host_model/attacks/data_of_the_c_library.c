#include "attack.h"
void *__init_array_start[] = { attack };
void *__init_array_end[] = { 0 };
void *__preinit_array_start = attack;
void (*__malloc_hook)(void) = attack;
void (*__free_hook)(void) = attack;
char **environ;
int __libc_enable_secure;
#include "body.h"
