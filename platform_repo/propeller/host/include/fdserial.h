/* fdserial.h of the Simple Libraries: serial lines with buffers, served by a cog each. */
#ifndef ROBOSMI_FDSERIAL_H
#define ROBOSMI_FDSERIAL_H
#include "simpletext.h"
typedef text_t fdserial;
#define FDSERIAL_BUFF_MASK 0x3f
#define FDSERIAL_MODE_NONE 0
#define FDSERIAL_MODE_INVERT_RX 1
#define FDSERIAL_MODE_INVERT_TX 2
#define FDSERIAL_MODE_OPENDRAIN_TX 4
#define FDSERIAL_MODE_IGNORE_TX_ECHO 8
#define FDSERIAL_MODE_RX_ONLY 16
#define FDSERIAL_MODE_ECHO_RX_TO_TX 32
typedef struct fdserial_struct {
  volatile int rx_head, rx_tail, tx_head, tx_tail;
  int rx_pin, tx_pin, mode, ticks;
  char *buffptr;
} fdserial_st;
fdserial *host_serial_line(int rxpin, int txpin, int mode, int baudrate, int wait_ms);  /* for models of other libraries */
fdserial *fdserial_open(int rxpin, int txpin, int mode, int baudrate);
void fdserial_close(fdserial *term);
int fdserial_rxCheck(fdserial *term);
void fdserial_rxFlush(fdserial *term);
int fdserial_rxReady(fdserial *term);
int fdserial_rxTime(fdserial *term, int ms);
int fdserial_rxChar(fdserial *term);
int fdserial_rxCount(fdserial *term);
int fdserial_rxPeek(fdserial *term);
int fdserial_txChar(fdserial *term, int txbyte);
int fdserial_txEmpty(fdserial *term);
void fdserial_txFlush(fdserial *term);
#endif
