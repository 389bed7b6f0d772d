"""How the parts of a running console hang together: `console` is the whole, the others are its sides."""
