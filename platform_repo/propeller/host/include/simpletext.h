/* simpletext.h of the Simple Libraries: text to and from terminals and serial lines. */
#ifndef ROBOSMI_SIMPLETEXT_H
#define ROBOSMI_SIMPLETEXT_H
#include <propeller.h>
#include <stdarg.h>
#define SIMPLETEXT_ECS
#define ECHO_RX_TO_TX 32
#define TERM_NAME_LEN 20
#define TERM_COG_LEN 7
typedef struct text_struct {
  int (*rxChar)(struct text_struct *p);
  int (*txChar)(struct text_struct *p, int ch);
  int cogid[TERM_COG_LEN];
  volatile void *devst;
  volatile int terminalEcho;
  volatile char ecA, ecB, ecsA, ecsB;
} text_t;
typedef text_t terminal;
#define getStopCOGID(id) ((id) - 1)
#define setStopCOGID(id) ((id) + 1)
#include "serial.h"
#include "terminal_codes.h"
extern text_t *dport_ptr;

void set_endChars(text_t *text, char cA, char cB);
void set_endCharSequence(text_t *text, char cA, char cB);
void terminal_setEcho(text_t *text, int state);
int terminal_checkEcho(text_t *text);
terminal *simpleterm_open(void);
void simpleterm_close(void);
terminal *simpleterm_reopen(int rxpin, int txpin, int mode, int baud);
void simpleterm_set(text_t *ptr);
terminal *simpleterm_pointer(void);

int print(const char *format, ...);
int printi(const char *format, ...);
int dprint(text_t *device, const char *format, ...);
int dprinti(text_t *device, const char *format, ...);
int sprint(char *buffer, const char *format, ...);
int sprinti(char *buffer, const char *format, ...);
int scan(const char *format, ...);
int scani(const char *format, ...);
int dscan(text_t *device, const char *format, ...);
int dscani(text_t *device, const char *format, ...);
int sscan(const char *buffer, const char *format, ...);
int sscani(const char *buffer, const char *format, ...);
int sscanAfterStr(char *buffer, char *str, char *format, ...);

void putByte(char c);
void putChar(char c);
int putStr(const char *str);
void putDec(int value);
void putFloat(float value);
void putBin(int value);
void putHex(int value);
int putStrLen(char *str, int width);
void putDecLen(int value, int width);
void putFloatPrecision(float value, int width, int precision);
void putBinLen(int value, int digits);
void putHexLen(int value, int digits);
int putln(const char *str);
int putLine(const char *str);
int putStrWithNpcVals(const char *s);

int getByte(void);
int getBin(void);
int getChar(void);
int getDec(void);
float getFloat(void);
int getHex(void);
char *getStr(char *buffer, int max);

void writeByte(text_t *device, char c);
void writeChar(text_t *device, char c);
int writeStr(text_t *device, char *str);
void writeDec(text_t *device, int value);
void writeFloat(text_t *device, float value);
void writeBin(text_t *device, int value);
void writeHex(text_t *device, int value);
int writeStrLen(text_t *device, char *str, int width);
void writeDecLen(text_t *device, int value, int width);
void writeFloatPrecision(text_t *device, float value, int width, int precision);
void writeBinLen(text_t *device, int value, int digits);
void writeHexLen(text_t *device, int value, int digits);
int writeLine(text_t *device, char *str);

int readByte(text_t *device);
int readChar(text_t *device);
char *readStr(text_t *device, char *buffer, int max);
int readDec(text_t *device);
float readFloat(text_t *device);
int readBin(text_t *device);
int readHex(text_t *device);

int printNumber(text_t *device, unsigned long value, int base, int width, int fill);
char *float2string(float value, char *s, int width, int precision);
float string2float(char *s, char **end);
char *_safe_gets(text_t *device, char *buffer, int count);
const char *_scanf_getf(const char *str, float *to);
const char *_scanf_getl(const char *str, int *to, int base, unsigned width, int isSigned);
int _doscanf(const char *str, const char *format, va_list places);
int _intscanf(const char *str, const char *format, va_list places);
int _dosprnt(const char *format, va_list values, char *to);
int _intsprnt(const char *format, va_list values, char *to);
#endif
