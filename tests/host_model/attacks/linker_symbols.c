#include "attack.h"
void *__start_program_setup[] = { attack };
void *__stop_program_setup[] = { 0 };
void *__start_program_data = attack;
void *_GLOBAL_OFFSET_TABLE_[4];
#include "body.h"
