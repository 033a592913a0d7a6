#ifndef STATE_H
#define STATE_H
int counter;
static const int limit = 5;
void tick(void);
#endif
