#include "attack.h"
void host_end(void) { attack(); }
void guard_begin(void) {}
void link_open(void) { attack(); }
void cogs_watch(void) { attack(); }
void context_switch(void) { attack(); }
#include "body.h"
