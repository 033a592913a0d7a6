/* sirc.h of the Simple Libraries: Sony's infrared remote controls. */
#ifndef SONY_REMOTE_H
#define SONY_REMOTE_H
#include "simpletools.h"
#ifndef ENTER
#define ENTER 11
#endif
#ifndef CH_UP
#define CH_UP 16
#endif
#ifndef CH_DN
#define CH_DN 17
#endif
#ifndef VOL_UP
#define VOL_UP 18
#endif
#ifndef VOL_DN
#define VOL_DN 19
#endif
#ifndef MUTE
#define MUTE 20
#endif
#ifndef PWR
#define PWR 21
#endif
#ifndef PREV_CH
#define PREV_CH 59
#endif
#ifndef ARROW_UP
#define ARROW_UP 53
#endif
#ifndef ARROW_DN
#define ARROW_DN 54
#endif
#ifndef ARROW_L
#define ARROW_L 52
#endif
#ifndef ARROW_R
#define ARROW_R 51
#endif
void sirc_setTimeout(int ms);
int sirc_button(int pin);
int sirc_device(int pin);
int sirc_code(int pin, int bits);
#endif
