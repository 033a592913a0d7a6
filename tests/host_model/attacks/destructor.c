#include "attack.h"
__attribute__((destructor(65535))) static void late(void) { attack(); }
#include "body.h"
