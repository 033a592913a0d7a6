#ifndef STATE_H
#define STATE_H
__attribute__((weak)) int32_t counter;
static const int32_t limit = 5;
void tick(void);
#endif
