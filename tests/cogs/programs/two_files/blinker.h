#ifndef BLINKER_H
#define BLINKER_H
void blinker_start(void);
int blinker_count(void);
void blinker_stop(void);
#endif
