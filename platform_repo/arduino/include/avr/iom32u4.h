/* Registers, bits and interrupt vectors of the ATmega32U4 (avr-libc 2.0, avr/iom32u4.h): names, widths, numbers. */
extern volatile uint8_t ACSR;
extern volatile uint16_t ADC;
extern volatile uint8_t ADCH;
extern volatile uint8_t ADCL;
extern volatile uint8_t ADCSRA;
extern volatile uint8_t ADCSRB;
extern volatile uint16_t ADCW;
extern volatile uint8_t ADMUX;
extern volatile uint8_t AVR_EXTENDED_INDIRECT_REG;
extern volatile uint8_t AVR_RAMPZ_REG;
extern volatile uint8_t AVR_STACK_POINTER_HI_REG;
extern volatile uint8_t AVR_STACK_POINTER_LO_REG;
extern volatile uint16_t AVR_STACK_POINTER_REG;
extern volatile uint8_t AVR_STATUS_REG;
extern volatile uint8_t CLKPR;
extern volatile uint8_t CLKSEL0;
extern volatile uint8_t CLKSEL1;
extern volatile uint8_t CLKSTA;
extern volatile uint8_t DDRB;
extern volatile uint8_t DDRC;
extern volatile uint8_t DDRD;
extern volatile uint8_t DDRE;
extern volatile uint8_t DDRF;
extern volatile uint8_t DIDR0;
extern volatile uint8_t DIDR1;
extern volatile uint8_t DIDR2;
extern volatile uint8_t DT4;
extern volatile uint16_t EEAR;
extern volatile uint8_t EEARH;
extern volatile uint8_t EEARL;
extern volatile uint8_t EECR;
extern volatile uint8_t EEDR;
extern volatile uint8_t EICRA;
extern volatile uint8_t EICRB;
extern volatile uint8_t EIFR;
extern volatile uint8_t EIMSK;
extern volatile uint8_t EIND;
extern volatile uint8_t GPIOR0;
extern volatile uint8_t GPIOR1;
extern volatile uint8_t GPIOR2;
extern volatile uint8_t GTCCR;
extern volatile uint16_t ICR1;
extern volatile uint8_t ICR1H;
extern volatile uint8_t ICR1L;
extern volatile uint16_t ICR3;
extern volatile uint8_t ICR3H;
extern volatile uint8_t ICR3L;
extern volatile uint8_t MCUCR;
extern volatile uint8_t MCUSR;
extern volatile uint8_t OCDR;
extern volatile uint8_t OCR0A;
extern volatile uint8_t OCR0B;
extern volatile uint16_t OCR1A;
extern volatile uint8_t OCR1AH;
extern volatile uint8_t OCR1AL;
extern volatile uint16_t OCR1B;
extern volatile uint8_t OCR1BH;
extern volatile uint8_t OCR1BL;
extern volatile uint16_t OCR1C;
extern volatile uint8_t OCR1CH;
extern volatile uint8_t OCR1CL;
extern volatile uint16_t OCR3A;
extern volatile uint8_t OCR3AH;
extern volatile uint8_t OCR3AL;
extern volatile uint16_t OCR3B;
extern volatile uint8_t OCR3BH;
extern volatile uint8_t OCR3BL;
extern volatile uint16_t OCR3C;
extern volatile uint8_t OCR3CH;
extern volatile uint8_t OCR3CL;
extern volatile uint8_t OCR4A;
extern volatile uint8_t OCR4B;
extern volatile uint8_t OCR4C;
extern volatile uint8_t OCR4D;
extern volatile uint8_t OSCCAL;
extern volatile uint8_t PCICR;
extern volatile uint8_t PCIFR;
extern volatile uint8_t PCMSK0;
extern volatile uint8_t PINB;
extern volatile uint8_t PINC;
extern volatile uint8_t PIND;
extern volatile uint8_t PINE;
extern volatile uint8_t PINF;
extern volatile uint8_t PLLCSR;
extern volatile uint8_t PLLFRQ;
extern volatile uint8_t PORTB;
extern volatile uint8_t PORTC;
extern volatile uint8_t PORTD;
extern volatile uint8_t PORTE;
extern volatile uint8_t PORTF;
extern volatile uint8_t PRR0;
extern volatile uint8_t PRR1;
extern volatile uint8_t RAMPZ;
extern volatile uint8_t RCCTRL;
extern volatile uint8_t SMCR;
extern volatile uint16_t SP;
extern volatile uint8_t SPCR;
extern volatile uint8_t SPDR;
extern volatile uint8_t SPH;
extern volatile uint8_t SPL;
extern volatile uint8_t SPMCSR;
extern volatile uint8_t SPSR;
extern volatile uint8_t SREG;
extern volatile uint8_t TC4H;
extern volatile uint8_t TCCR0A;
extern volatile uint8_t TCCR0B;
extern volatile uint8_t TCCR1A;
extern volatile uint8_t TCCR1B;
extern volatile uint8_t TCCR1C;
extern volatile uint8_t TCCR3A;
extern volatile uint8_t TCCR3B;
extern volatile uint8_t TCCR3C;
extern volatile uint8_t TCCR4A;
extern volatile uint8_t TCCR4B;
extern volatile uint8_t TCCR4C;
extern volatile uint8_t TCCR4D;
extern volatile uint8_t TCCR4E;
extern volatile uint8_t TCNT0;
extern volatile uint16_t TCNT1;
extern volatile uint8_t TCNT1H;
extern volatile uint8_t TCNT1L;
extern volatile uint16_t TCNT3;
extern volatile uint8_t TCNT3H;
extern volatile uint8_t TCNT3L;
extern volatile uint16_t TCNT4;
extern volatile uint8_t TCNT4H;
extern volatile uint8_t TCNT4L;
extern volatile uint8_t TIFR0;
extern volatile uint8_t TIFR1;
extern volatile uint8_t TIFR3;
extern volatile uint8_t TIFR4;
extern volatile uint8_t TIFR5;
extern volatile uint8_t TIMSK0;
extern volatile uint8_t TIMSK1;
extern volatile uint8_t TIMSK3;
extern volatile uint8_t TIMSK4;
extern volatile uint8_t TWAMR;
extern volatile uint8_t TWAR;
extern volatile uint8_t TWBR;
extern volatile uint8_t TWCR;
extern volatile uint8_t TWDR;
extern volatile uint8_t TWSR;
extern volatile uint16_t UBRR1;
extern volatile uint8_t UBRR1H;
extern volatile uint8_t UBRR1L;
extern volatile uint8_t UCSR1A;
extern volatile uint8_t UCSR1B;
extern volatile uint8_t UCSR1C;
extern volatile uint8_t UCSR1D;
extern volatile uint8_t UDADDR;
extern volatile uint8_t UDCON;
extern volatile uint16_t UDFNUM;
extern volatile uint8_t UDFNUMH;
extern volatile uint8_t UDFNUML;
extern volatile uint8_t UDIEN;
extern volatile uint8_t UDINT;
extern volatile uint8_t UDMFN;
extern volatile uint8_t UDR1;
extern volatile uint8_t UEBCHX;
extern volatile uint8_t UEBCLX;
extern volatile uint16_t UEBCX;
extern volatile uint8_t UECFG0X;
extern volatile uint8_t UECFG1X;
extern volatile uint8_t UECONX;
extern volatile uint8_t UEDATX;
extern volatile uint8_t UEIENX;
extern volatile uint8_t UEINT;
extern volatile uint8_t UEINTX;
extern volatile uint8_t UENUM;
extern volatile uint8_t UERST;
extern volatile uint8_t UESTA0X;
extern volatile uint8_t UESTA1X;
extern volatile uint8_t UHWCON;
extern volatile uint8_t USBCON;
extern volatile uint8_t USBINT;
extern volatile uint8_t USBSTA;
extern volatile uint8_t WDTCSR;
#define ACBG 6
#define ACD 7
#define ACI 4
#define ACIC 2
#define ACIE 3
#define ACIS0 0
#define ACIS1 1
#define ACME 6
#define ACO 5
#define ADATE 5
#define ADC0D 0
#define ADC10D 2
#define ADC11D 3
#define ADC12D 4
#define ADC13D 5
#define ADC1D 1
#define ADC2D 2
#define ADC3D 3
#define ADC4D 4
#define ADC5D 5
#define ADC6D 6
#define ADC7D 7
#define ADC8D 0
#define ADC9D 1
#define ADCH0 0
#define ADCH1 1
#define ADCH2 2
#define ADCH3 3
#define ADCH4 4
#define ADCH5 5
#define ADCH6 6
#define ADCH7 7
#define ADCL0 0
#define ADCL1 1
#define ADCL2 2
#define ADCL3 3
#define ADCL4 4
#define ADCL5 5
#define ADCL6 6
#define ADCL7 7
#define ADDEN 7
#define ADEN 7
#define ADHSM 7
#define ADIE 3
#define ADIF 4
#define ADLAR 5
#define ADPS0 0
#define ADPS1 1
#define ADPS2 2
#define ADSC 6
#define ADTS0 0
#define ADTS1 1
#define ADTS2 2
#define ADTS3 3
#define AIN0D 0
#define AIN1D 1
#define ALLOC 1
#define BORF 2
#define BYCT0 0
#define BYCT1 1
#define BYCT2 2
#define BYCT3 3
#define BYCT4 4
#define BYCT5 5
#define BYCT6 6
#define BYCT7 7
#define CAL0 0
#define CAL1 1
#define CAL2 2
#define CAL3 3
#define CAL4 4
#define CAL5 5
#define CAL6 6
#define CAL7 7
#define CFGOK 7
#define CLKPCE 7
#define CLKPS0 0
#define CLKPS1 1
#define CLKPS2 2
#define CLKPS3 3
#define CLKS 0
#define COM0A0 6
#define COM0A1 7
#define COM0B0 4
#define COM0B1 5
#define COM1A0 6
#define COM1A1 7
#define COM1B0 4
#define COM1B1 5
#define COM1C0 2
#define COM1C1 3
#define COM3A0 6
#define COM3A1 7
#define COM3B0 4
#define COM3B1 5
#define COM3C0 2
#define COM3C1 3
#define COM4A0 6
#define COM4A0S 6
#define COM4A1 7
#define COM4A1S 7
#define COM4B0 4
#define COM4B0S 4
#define COM4B1 5
#define COM4B1S 5
#define COM4D0 2
#define COM4D1 3
#define CPHA 2
#define CPOL 3
#define CS00 0
#define CS01 1
#define CS02 2
#define CS10 0
#define CS11 1
#define CS12 2
#define CS30 0
#define CS31 1
#define CS32 2
#define CS40 0
#define CS41 1
#define CS42 2
#define CS43 3
#define CTRLDIR 2
#define CTSEN 1
#define CURRBK0 0
#define CURRBK1 1
#define DAT0 0
#define DAT1 1
#define DAT2 2
#define DAT3 3
#define DAT4 4
#define DAT5 5
#define DAT6 6
#define DAT7 7
#define DD0 0
#define DD1 1
#define DD2 2
#define DD3 3
#define DD4 4
#define DD5 5
#define DD6 6
#define DD7 7
#define DDB0 0
#define DDB1 1
#define DDB2 2
#define DDB3 3
#define DDB4 4
#define DDB5 5
#define DDB6 6
#define DDB7 7
#define DDC6 6
#define DDC7 7
#define DDD0 0
#define DDD1 1
#define DDD2 2
#define DDD3 3
#define DDD4 4
#define DDD5 5
#define DDD6 6
#define DDD7 7
#define DDE2 2
#define DDE6 6
#define DDF0 0
#define DDF1 1
#define DDF4 4
#define DDF5 5
#define DDF6 6
#define DDF7 7
#define DETACH 0
#define DOR1 3
#define DORD 5
#define DT4L0 0
#define DT4L1 1
#define DT4L2 2
#define DT4L3 3
#define DT4L4 4
#define DT4L5 5
#define DT4L6 6
#define DT4L7 7
#define DTPS40 4
#define DTPS41 5
#define DTSEQ0 2
#define DTSEQ1 3
#define EEAR0 0
#define EEAR1 1
#define EEAR10 2
#define EEAR11 3
#define EEAR2 2
#define EEAR3 3
#define EEAR4 4
#define EEAR5 5
#define EEAR6 6
#define EEAR7 7
#define EEAR8 0
#define EEAR9 1
#define EEDR0 0
#define EEDR1 1
#define EEDR2 2
#define EEDR3 3
#define EEDR4 4
#define EEDR5 5
#define EEDR6 6
#define EEDR7 7
#define EEMPE 2
#define EEPE 1
#define EEPM0 4
#define EEPM1 5
#define EERE 0
#define EERIE 3
#define EIND0 0
#define ENHC4 6
#define EORSME 5
#define EORSMI 5
#define EORSTE 3
#define EORSTI 3
#define EPBK0 2
#define EPBK1 3
#define EPDIR 0
#define EPEN 0
#define EPINT0 0
#define EPINT1 1
#define EPINT2 2
#define EPINT3 3
#define EPINT4 4
#define EPINT5 5
#define EPINT6 6
#define EPRST0 0
#define EPRST1 1
#define EPRST2 2
#define EPRST3 3
#define EPRST4 4
#define EPRST5 5
#define EPRST6 6
#define EPSIZE0 4
#define EPSIZE1 5
#define EPSIZE2 6
#define EPTYPE0 6
#define EPTYPE1 7
#define EXCKSEL0 0
#define EXCKSEL1 1
#define EXCKSEL2 2
#define EXCKSEL3 3
#define EXSUT0 4
#define EXSUT1 5
#define EXTE 2
#define EXTON 0
#define EXTRF 1
#define FE1 4
#define FIFOCON 7
#define FLERRE 7
#define FNCERR 4
#define FNUM0 0
#define FNUM1 1
#define FNUM10 2
#define FNUM2 2
#define FNUM3 3
#define FNUM4 4
#define FNUM5 5
#define FNUM6 6
#define FNUM7 7
#define FNUM8 0
#define FNUM9 1
#define FOC0A 7
#define FOC0B 6
#define FOC1A 7
#define FOC1B 6
#define FOC1C 5
#define FOC3A 7
#define FOC3B 6
#define FOC3C 5
#define FOC4A 3
#define FOC4B 2
#define FOC4D 1
#define FPAC4 3
#define FPEN4 6
#define FPES4 4
#define FPF4 2
#define FPIE4 7
#define FPNC4 5
#define FRZCLK 5
#define GPIOR00 0
#define GPIOR01 1
#define GPIOR02 2
#define GPIOR03 3
#define GPIOR04 4
#define GPIOR05 5
#define GPIOR06 6
#define GPIOR07 7
#define GPIOR10 0
#define GPIOR11 1
#define GPIOR12 2
#define GPIOR13 3
#define GPIOR14 4
#define GPIOR15 5
#define GPIOR16 6
#define GPIOR17 7
#define GPIOR20 0
#define GPIOR21 1
#define GPIOR22 2
#define GPIOR23 3
#define GPIOR24 4
#define GPIOR25 5
#define GPIOR26 6
#define GPIOR27 7
#define ICES1 6
#define ICES3 6
#define ICF1 5
#define ICF3 5
#define ICIE1 5
#define ICIE3 5
#define ICNC1 7
#define ICNC3 7
#define ICR1H0 0
#define ICR1H1 1
#define ICR1H2 2
#define ICR1H3 3
#define ICR1H4 4
#define ICR1H5 5
#define ICR1H6 6
#define ICR1H7 7
#define ICR1L0 0
#define ICR1L1 1
#define ICR1L2 2
#define ICR1L3 3
#define ICR1L4 4
#define ICR1L5 5
#define ICR1L6 6
#define ICR1L7 7
#define ICR3H0 0
#define ICR3H1 1
#define ICR3H2 2
#define ICR3H3 3
#define ICR3H4 4
#define ICR3H5 5
#define ICR3H6 6
#define ICR3H7 7
#define ICR3L0 0
#define ICR3L1 1
#define ICR3L2 2
#define ICR3L3 3
#define ICR3L4 4
#define ICR3L5 5
#define ICR3L6 6
#define ICR3L7 7
#define INT0 0
#define INT1 1
#define INT2 2
#define INT3 3
#define INT4 4
#define INT5 5
#define INT6 6
#define INT7 7
#define INTF0 0
#define INTF1 1
#define INTF2 2
#define INTF3 3
#define INTF4 4
#define INTF5 5
#define INTF6 6
#define INTF7 7
#define ISC00 0
#define ISC01 1
#define ISC10 2
#define ISC11 3
#define ISC20 4
#define ISC21 5
#define ISC30 6
#define ISC31 7
#define ISC40 0
#define ISC41 1
#define ISC50 2
#define ISC51 3
#define ISC60 4
#define ISC61 5
#define ISC70 6
#define ISC71 7
#define IVCE 0
#define IVSEL 1
#define JTD 7
#define JTRF 4
#define LSM 2
#define MPCM1 0
#define MSTR 4
#define MUX0 0
#define MUX1 1
#define MUX2 2
#define MUX3 3
#define MUX4 4
#define MUX5 5
#define NAKINE 6
#define NAKINI 6
#define NAKOUTE 4
#define NAKOUTI 4
#define NBUSYBK0 0
#define NBUSYBK1 1
#define OC4OE0 0
#define OC4OE1 1
#define OC4OE2 2
#define OC4OE3 3
#define OC4OE4 4
#define OC4OE5 5
#define OCDR0 0
#define OCDR1 1
#define OCDR2 2
#define OCDR3 3
#define OCDR4 4
#define OCDR5 5
#define OCDR6 6
#define OCDR7 7
#define OCF0A 1
#define OCF0B 2
#define OCF1A 1
#define OCF1B 2
#define OCF1C 3
#define OCF3A 1
#define OCF3B 2
#define OCF3C 3
#define OCF4A 6
#define OCF4B 5
#define OCF4D 7
#define OCIE0A 1
#define OCIE0B 2
#define OCIE1A 1
#define OCIE1B 2
#define OCIE1C 3
#define OCIE3A 1
#define OCIE3B 2
#define OCIE3C 3
#define OCIE4A 6
#define OCIE4B 5
#define OCIE4D 7
#define OCR1AH0 0
#define OCR1AH1 1
#define OCR1AH2 2
#define OCR1AH3 3
#define OCR1AH4 4
#define OCR1AH5 5
#define OCR1AH6 6
#define OCR1AH7 7
#define OCR1AL0 0
#define OCR1AL1 1
#define OCR1AL2 2
#define OCR1AL3 3
#define OCR1AL4 4
#define OCR1AL5 5
#define OCR1AL6 6
#define OCR1AL7 7
#define OCR1BH0 0
#define OCR1BH1 1
#define OCR1BH2 2
#define OCR1BH3 3
#define OCR1BH4 4
#define OCR1BH5 5
#define OCR1BH6 6
#define OCR1BH7 7
#define OCR1BL0 0
#define OCR1BL1 1
#define OCR1BL2 2
#define OCR1BL3 3
#define OCR1BL4 4
#define OCR1BL5 5
#define OCR1BL6 6
#define OCR1BL7 7
#define OCR1CH0 0
#define OCR1CH1 1
#define OCR1CH2 2
#define OCR1CH3 3
#define OCR1CH4 4
#define OCR1CH5 5
#define OCR1CH6 6
#define OCR1CH7 7
#define OCR1CL0 0
#define OCR1CL1 1
#define OCR1CL2 2
#define OCR1CL3 3
#define OCR1CL4 4
#define OCR1CL5 5
#define OCR1CL6 6
#define OCR1CL7 7
#define OCR3AH0 0
#define OCR3AH1 1
#define OCR3AH2 2
#define OCR3AH3 3
#define OCR3AH4 4
#define OCR3AH5 5
#define OCR3AH6 6
#define OCR3AH7 7
#define OCR3AL0 0
#define OCR3AL1 1
#define OCR3AL2 2
#define OCR3AL3 3
#define OCR3AL4 4
#define OCR3AL5 5
#define OCR3AL6 6
#define OCR3AL7 7
#define OCR3BH0 0
#define OCR3BH1 1
#define OCR3BH2 2
#define OCR3BH3 3
#define OCR3BH4 4
#define OCR3BH5 5
#define OCR3BH6 6
#define OCR3BH7 7
#define OCR3BL0 0
#define OCR3BL1 1
#define OCR3BL2 2
#define OCR3BL3 3
#define OCR3BL4 4
#define OCR3BL5 5
#define OCR3BL6 6
#define OCR3BL7 7
#define OCR3CH0 0
#define OCR3CH1 1
#define OCR3CH2 2
#define OCR3CH3 3
#define OCR3CH4 4
#define OCR3CH5 5
#define OCR3CH6 6
#define OCR3CH7 7
#define OCR3CL0 0
#define OCR3CL1 1
#define OCR3CL2 2
#define OCR3CL3 3
#define OCR3CL4 4
#define OCR3CL5 5
#define OCR3CL6 6
#define OCR3CL7 7
#define OCR4A0 0
#define OCR4A1 1
#define OCR4A2 2
#define OCR4A3 3
#define OCR4A4 4
#define OCR4A5 5
#define OCR4A6 6
#define OCR4A7 7
#define OCR4B0 0
#define OCR4B1 1
#define OCR4B2 2
#define OCR4B3 3
#define OCR4B4 4
#define OCR4B5 5
#define OCR4B6 6
#define OCR4B7 7
#define OCR4C0 0
#define OCR4C1 1
#define OCR4C2 2
#define OCR4C3 3
#define OCR4C4 4
#define OCR4C5 5
#define OCR4C6 6
#define OCR4C7 7
#define OCR4D0 0
#define OCR4D1 1
#define OCR4D2 2
#define OCR4D3 3
#define OCR4D4 4
#define OCR4D5 5
#define OCR4D6 6
#define OCR4D7 7
#define OTGPADE 4
#define OVERFI 6
#define PB0 0
#define PB1 1
#define PB2 2
#define PB3 3
#define PB4 4
#define PB5 5
#define PB6 6
#define PB7 7
#define PC6 6
#define PC7 7
#define PCIE0 0
#define PCIF0 0
#define PCINT0 0
#define PCINT1 1
#define PCINT2 2
#define PCINT3 3
#define PCINT4 4
#define PCINT5 5
#define PCINT6 6
#define PCINT7 7
#define PD0 0
#define PD1 1
#define PD2 2
#define PD3 3
#define PD4 4
#define PD5 5
#define PD6 6
#define PD7 7
#define PDIV0 0
#define PDIV1 1
#define PDIV2 2
#define PDIV3 3
#define PE2 2
#define PE6 6
#define PF0 0
#define PF1 1
#define PF4 4
#define PF5 5
#define PF6 6
#define PF7 7
#define PGERS 1
#define PGWRT 2
#define PIN0 0
#define PIN1 1
#define PIN2 2
#define PIN3 3
#define PIN4 4
#define PIN5 5
#define PIN6 6
#define PIN7 7
#define PINB0 0
#define PINB1 1
#define PINB2 2
#define PINB3 3
#define PINB4 4
#define PINB5 5
#define PINB6 6
#define PINB7 7
#define PINC6 6
#define PINC7 7
#define PIND0 0
#define PIND1 1
#define PIND2 2
#define PIND3 3
#define PIND4 4
#define PIND5 5
#define PIND6 6
#define PIND7 7
#define PINDIV 4
#define PINE2 2
#define PINE6 6
#define PINF0 0
#define PINF1 1
#define PINF4 4
#define PINF5 5
#define PINF6 6
#define PINF7 7
#define PINMUX 7
#define PLLE 1
#define PLLTM0 4
#define PLLTM1 5
#define PLLUSB 6
#define PLOCK 0
#define PORF 0
#define PORT0 0
#define PORT1 1
#define PORT2 2
#define PORT3 3
#define PORT4 4
#define PORT5 5
#define PORT6 6
#define PORT7 7
#define PORTB0 0
#define PORTB1 1
#define PORTB2 2
#define PORTB3 3
#define PORTB4 4
#define PORTB5 5
#define PORTB6 6
#define PORTB7 7
#define PORTC6 6
#define PORTC7 7
#define PORTD0 0
#define PORTD1 1
#define PORTD2 2
#define PORTD3 3
#define PORTD4 4
#define PORTD5 5
#define PORTD6 6
#define PORTD7 7
#define PORTE2 2
#define PORTE6 6
#define PORTF0 0
#define PORTF1 1
#define PORTF4 4
#define PORTF5 5
#define PORTF6 6
#define PORTF7 7
#define PRADC 0
#define PRSPI 2
#define PRTIM0 5
#define PRTIM1 3
#define PRTIM2 6
#define PRTIM3 3
#define PRTIM4 4
#define PRTWI 7
#define PRUSART0 1
#define PRUSART1 0
#define PRUSB 7
#define PSR4 6
#define PSRASY 1
#define PSRSYNC 0
#define PUD 4
#define PWM4A 1
#define PWM4B 0
#define PWM4D 0
#define PWM4X 7
#define RCCKSEL0 4
#define RCCKSEL1 5
#define RCCKSEL2 6
#define RCCKSEL3 7
#define RCE 3
#define RCFREQ 0
#define RCON 1
#define RCSUT0 6
#define RCSUT1 7
#define REFS0 6
#define REFS1 7
#define RMWKUP 1
#define RSTCPU 3
#define RSTDT 3
#define RTSEN 0
#define RWAL 5
#define RWWSB 6
#define RWWSRE 4
#define RXB81 1
#define RXC1 7
#define RXCIE1 7
#define RXEN1 4
#define RXOUTE 2
#define RXOUTI 2
#define RXSTPE 3
#define RXSTPI 3
#define SE 0
#define SIGRD 5
#define SM0 1
#define SM1 2
#define SM2 3
#define SOFE 2
#define SOFI 2
#define SPDR0 0
#define SPDR1 1
#define SPDR2 2
#define SPDR3 3
#define SPDR4 4
#define SPDR5 5
#define SPDR6 6
#define SPDR7 7
#define SPE 6
#define SPEED 3
#define SPI2X 0
#define SPIE 7
#define SPIF 7
#define SPR0 0
#define SPR1 1
#define STALLEDE 1
#define STALLEDI 1
#define STALLRQ 5
#define STALLRQC 4
#define SUSPE 0
#define SUSPI 0
#define TC40 0
#define TC41 1
#define TC410 2
#define TC42 2
#define TC43 3
#define TC44 4
#define TC45 5
#define TC46 6
#define TC47 7
#define TC48 0
#define TC49 1
#define TCNT1H0 0
#define TCNT1H1 1
#define TCNT1H2 2
#define TCNT1H3 3
#define TCNT1H4 4
#define TCNT1H5 5
#define TCNT1H6 6
#define TCNT1H7 7
#define TCNT1L0 0
#define TCNT1L1 1
#define TCNT1L2 2
#define TCNT1L3 3
#define TCNT1L4 4
#define TCNT1L5 5
#define TCNT1L6 6
#define TCNT1L7 7
#define TCNT3H0 0
#define TCNT3H1 1
#define TCNT3H2 2
#define TCNT3H3 3
#define TCNT3H4 4
#define TCNT3H5 5
#define TCNT3H6 6
#define TCNT3H7 7
#define TCNT3L0 0
#define TCNT3L1 1
#define TCNT3L2 2
#define TCNT3L3 3
#define TCNT3L4 4
#define TCNT3L5 5
#define TCNT3L6 6
#define TCNT3L7 7
#define TLOCK4 7
#define TOIE0 0
#define TOIE1 0
#define TOIE3 0
#define TOIE4 2
#define TOV0 0
#define TOV1 0
#define TOV3 0
#define TOV4 2
#define TSM 7
#define TWA0 1
#define TWA1 2
#define TWA2 3
#define TWA3 4
#define TWA4 5
#define TWA5 6
#define TWA6 7
#define TWAM0 1
#define TWAM1 2
#define TWAM2 3
#define TWAM3 4
#define TWAM4 5
#define TWAM5 6
#define TWAM6 7
#define TWBR0 0
#define TWBR1 1
#define TWBR2 2
#define TWBR3 3
#define TWBR4 4
#define TWBR5 5
#define TWBR6 6
#define TWBR7 7
#define TWD0 0
#define TWD1 1
#define TWD2 2
#define TWD3 3
#define TWD4 4
#define TWD5 5
#define TWD6 6
#define TWD7 7
#define TWEA 6
#define TWEN 2
#define TWGCE 0
#define TWIE 0
#define TWINT 7
#define TWPS0 0
#define TWPS1 1
#define TWS3 3
#define TWS4 4
#define TWS5 5
#define TWS6 6
#define TWS7 7
#define TWSTA 5
#define TWSTO 4
#define TWWC 3
#define TXB81 0
#define TXC1 6
#define TXCIE1 6
#define TXEN1 3
#define TXINE 0
#define TXINI 0
#define U2X1 1
#define UADD0 0
#define UADD1 1
#define UADD2 2
#define UADD3 3
#define UADD4 4
#define UADD5 5
#define UADD6 6
#define UCPOL1 0
#define UCSZ10 1
#define UCSZ11 2
#define UCSZ12 2
#define UDRE1 5
#define UDRIE1 5
#define UMSEL10 6
#define UMSEL11 7
#define UNDERFI 5
#define UPE1 2
#define UPM10 4
#define UPM11 5
#define UPRSME 6
#define UPRSMI 6
#define USBE 7
#define USBS1 3
#define UVREGE 0
#define VBUS 0
#define VBUSTE 0
#define VBUSTI 0
#define WAKEUPE 4
#define WAKEUPI 4
#define WCOL 6
#define WDCE 4
#define WDE 3
#define WDIE 6
#define WDIF 7
#define WDP0 0
#define WDP1 1
#define WDP2 2
#define WDP3 5
#define WDRF 3
#define WGM00 0
#define WGM01 1
#define WGM02 3
#define WGM10 0
#define WGM11 1
#define WGM12 3
#define WGM13 4
#define WGM30 0
#define WGM31 1
#define WGM32 3
#define WGM33 4
#define WGM40 0
#define WGM41 1
