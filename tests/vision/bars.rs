//! What the front end promises, measured on rendered pictures against their truth.

mod localisation;
