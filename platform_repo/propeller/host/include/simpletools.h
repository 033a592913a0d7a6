/* simpletools.h of the Simple Libraries: time, pins, timed inputs and outputs, EEPROM, cogs, small arithmetic. */
#ifndef SIMPLETOOLS_H
#define SIMPLETOOLS_H
#include <propeller.h>
#include "simpletext.h"
#include <driver.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cog.h>
#include <ctype.h>
#include <unistd.h>
#include <sys/stat.h>
#include <dirent.h>
#include <sys/sd.h>
#include <math.h>
#include "simplei2c.h"
#include "terminal_codes.h"

extern int ms, us, st_msTicks, st_usTicks, st_iodt, st_timeout, st_pauseTicks, st_mark, st_eeInitFlag;
extern unsigned int st_buscnt;
extern i2c *st_eeprom;
#ifndef PI
#define PI 3.141592653589793
#endif
#ifndef MSBPRE
#define MSBPRE 0
#endif
#ifndef LSBPRE
#define LSBPRE 1
#endif
#ifndef MSBPOST
#define MSBPOST 2
#endif
#ifndef LSBPOST
#define LSBPOST 3
#endif
#ifndef LSBFIRST
#define LSBFIRST 0
#endif
#ifndef MSBFIRST
#define MSBFIRST 1
#endif
#ifndef NCO_PWM_1
#define NCO_PWM_1 (4 << 26)
#endif
#ifndef CTR_NCO
#define CTR_NCO (4 << 26)
#endif
#ifndef CTR_PLL
#define CTR_PLL (2 << 26)
#endif
#ifndef DUTY_SE
#define DUTY_SE (6 << 26)
#endif
#ifndef EEPROM_ADDR
#define EEPROM_ADDR 0x50
#endif
#define ee_put_byte ee_putByte
#define ee_get_byte ee_getByte
#define ee_put_int ee_putInt
#define ee_get_int ee_getInt
#define ee_put_str ee_putStr
#define ee_get_str ee_getStr
#define ee_put_float32 ee_putFloat32
#define pause_ticks(ticks) __builtin_propeller_waitcnt((ticks) + CNT, 0)

void high(int pin);
void low(int pin);
int input(int pin);
unsigned int toggle(int pin);
unsigned int reverse(int pin);
unsigned int get_state(int pin);
unsigned int get_direction(int pin);
unsigned int get_output(int pin);
void set_direction(int pin, int direction);
void set_output(int pin, int state);
unsigned int get_states(int endPin, int startPin);
unsigned int get_directions(int endPin, int startPin);
unsigned int get_outputs(int endPin, int startPin);
void set_directions(int endPin, int startPin, unsigned int pattern);
void set_outputs(int endPin, int startPin, unsigned int pattern);

void pause(int time);
void set_pause_dt(int clockticks);
void mark(void);
int timeout(int time);
void wait(int time);

long count(int pin, long duration);
void dac_ctr(int pin, int channel, int dacVal);
void dac_ctr_res(int bits);
void dac_ctr_stop(void);
void freqout(int pin, int msTime, int frequency);
int pwm_start(unsigned int cycleMicroseconds);
void pwm_set(int pin, int channel, int tHigh);
void pwm_stop(void);
long pulse_in(int pin, int state);
void pulse_out(int pin, int time);
long rc_time(int pin, int state);
void square_wave(int pin, int channel, int freq);
void square_wave_stop(void);
void set_io_timeout(long clockTicks);
void set_io_dt(long clockticks);
int shift_in(int pinDat, int pinClk, int mode, int bits);
void shift_out(int pinDat, int pinClk, int mode, int bits, int value);

i2c *i2c_newbus(int sclPin, int sdaPin, int sclDrive);
int i2c_out(i2c *busID, int i2cAddr, int memAddr, int memAddrCount, const unsigned char *data, int dataCount);
int i2c_in(i2c *busID, int i2cAddr, int memAddr, int memAddrCount, unsigned char *data, int dataCount);
int i2c_busy(i2c *busID, int i2cAddr);
void ee_putByte(unsigned char value, int addr);
char ee_getByte(int addr);
void ee_putInt(int value, int addr);
int ee_getInt(int addr);
void ee_putStr(unsigned char *s, int n, int addr);
unsigned char *ee_getStr(unsigned char *s, int n, int addr);
void ee_putFloat32(float value, int addr);
float ee_getFloat32(int addr);
void ee_config(int sclPin, int sdaPin, int sclDrive);
int sd_mount(int doPin, int clkPin, int diPin, int csPin);

int *cog_run(void (*function)(void *par), int stacksize);
int cog_num(int *coginfo);
void cog_end(int *coginfo);

void term_cmd(int termConst, ...);
float constrainFloat(float value, float min, float max);
int constrainInt(int value, int min, int max);
void endianSwap(void *resultAddr, void *varAddr, int byteCount);
float mapFloat(float value, float fromMin, float fromMax, float toMin, float toMax);
int mapInt(int value, int fromMin, int fromMax, int toMin, int toMax);
int random(int limitLow, int limitHigh);
#endif
