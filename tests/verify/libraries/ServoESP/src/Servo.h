#error "for another processor"
