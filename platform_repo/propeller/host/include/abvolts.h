/* abvolts.h of the Simple Libraries: the board's converters from and to volts. */
#ifndef PROPAB_ABVOLTS_H
#define PROPAB_ABVOLTS_H
#include "simpletools.h"
#ifndef _abvolts_EE_start_
#define _abvolts_EE_start_ 63400
#endif
#ifndef _abvolts_EE_end_
#define _abvolts_EE_end_ 63400 + 16
#endif
void da_init(int pinDA0, int pinDA1);
void ad_init(int csPin, int sclPin, int doPin, int diPin);
void da_volts(int channel, float daVal);
float ad_volts(int channel);
void da_out(int channel, int daVal);
int ad_in(int channel);
void da_res(int bits);
void da_setupScale(void);
void da_useScale(void);
void da_stop(void);
#endif
