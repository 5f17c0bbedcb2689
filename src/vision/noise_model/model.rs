//! The constants, by the wing that uses them.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

fn zero_or_more(key: &str, value: f64) -> Result<(), OutOfRange> {
    limits::at_least(key, value, 0.0)
}

fn above_zero(key: &str, value: f64) -> Result<(), OutOfRange> {
    limits::positive(key, value)
}

fn a_share(key: &str, value: f64) -> Result<(), OutOfRange> {
    limits::within(key, value, 0.0, 1.0)
}

/// A table of constants: plain numbers, or numbers with where they come from.
macro_rules! part {
    ($(#[$about:meta])* $name:ident at $place:ident { $($(#[$meaning:meta])* $field:ident: $range:ident),+ $(,)? }) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name<T = f64> {
            $($(#[$meaning])* pub $field: T,)+
        }

        impl<T> $name<T> {
            /// Every constant with its key.
            fn entries(&self) -> Vec<(&'static str, &T)> {
                vec![$((concat!(stringify!($place), ".", stringify!($field)), &self.$field)),+]
            }

            fn map<U>(&self, of: &impl Fn(&T) -> U) -> $name<U> {
                $name { $($field: of(&self.$field)),+ }
            }
        }

        impl $name {
            /// Checks every range.
            ///
            /// # Errors
            /// Names the key.
            pub fn validate(&self) -> Result<(), OutOfRange> {
                $($range(stringify!($field), self.$field)?;)+
                Ok(())
            }
        }

        impl Default for $name {
            fn default() -> Self {
                NoiseModel::default().$place
            }
        }
    };
}

part! {
    /// Error of a corner's pixel, of covariance `change² S² + factor² σ² T⁻¹`: `S` the spread of the response's peak
    /// (its height over its curvature, px²), `T` the structure tensor of the smoothed image (DN²), `σ` the image's noise (DN).
    /// Enters `features/subpixel_peak.rs`.
    CornerNoise at corner {
        /// What changes between two images besides noise tilts the response about a peak by this share of its height, 1/px,
        /// 0 or more.
        change_per_px: zero_or_more,
        /// 1σ of a peak over the bound of the structure tensor, 0 or more: the peak does not use its window as well as that
        /// would.
        noise_factor: zero_or_more,
    }
}

part! {
    /// Error of an aligned patch against the patch that it is aligned with, of covariance `shared m N⁻¹ + floor² I`: `N` the
    /// normal matrix of the alignment (DN²/px²), `m` its mean squared misfit (DN²). Enters `patch/`.
    PatchNoise at patch {
        /// So many neighbouring pixels share their noise and count as one, above 0.
        shared_pixels: above_zero,
        /// 1σ of each coordinate that the ground's own change between two images leaves without noise, px, 0 or more.
        floor_sigma_px: zero_or_more,
    }
}

part! {
    /// Localisation errors that vary smoothly over an image of ground or of any scene, besides white noise: polynomials of
    /// third order whose coefficients have the variance `share · over_likeliest` in units of the noise's, with
    /// `share = correlated_error_share · (1 + growth_by_view v / (1 + v / far_view))` and `v` the squared translation over the
    /// distance. Enters `pair/motion.rs` and `pair/covariance/`.
    PairNoise at pair {
        /// Expected variance of the coefficients over the noise's, as residuals show it between images from one place, 0 to 1;
        /// 0 where pixels err by white noise alone, as simulated ones do.
        correlated_error_share: a_share,
        /// By how many times itself that share grows with `v`, as long as `v` is small, 0 or more: the looks of ground change
        /// with the view.
        growth_by_view: zero_or_more,
        /// The `v` at which it has grown by half of what it can, above 0.
        far_view: above_zero,
        /// The coefficients' true variance over what residuals show, above 0: a motion imitates the rest.
        over_likeliest: above_zero,
    }
}

part! {
    /// The same over a body that turns before a camera, where the light moves over the surface; no growth is known. Enters
    /// `pair/fixed_center/solve.rs`.
    BodyNoise at body {
        /// Expected variance of the coefficients over the noise's, as residuals show it, 0 to 1; 0 where pixels err by white
        /// noise alone.
        correlated_error_share: a_share,
        /// The coefficients' true variance over what residuals show, above 0.
        over_likeliest: above_zero,
    }
}

part! {
    /// Error of the designated point that is carried from image to image. Enters `designated/keyframes.rs`.
    DesignatedNoise at designated {
        /// 1σ, in each coordinate, by which the looks of the ground move over the ground as scale grows e-fold, px, 0 or more:
        /// finer details appear, and all past images are wrong alike about where the point is among them.
        looks_sigma_px: zero_or_more,
        /// 1σ that an e-fold change of scale between two tied images adds to a tie, px, 0 or more: patches look less and less
        /// alike.
        scale_sigma_px: zero_or_more,
        /// Share of a tie's variance that all ties to an image have in common, 0 to 1: that image's own noise.
        common_share: a_share,
    }
}

part! {
    /// Error of a map's point in an image, px of the halved image. Enters `map/` and, by the last constant, the landing
    /// filter's use of a map.
    MapNoise at map {
        /// 1σ of each coordinate of what a map and an image of other distance show differently, on top of the patch's, px,
        /// 0 or more.
        looks_sigma_px: zero_or_more,
        /// 1σ of each coordinate of the shift that all points of an image have in common, px, 0 or more.
        common_sigma_px: zero_or_more,
        /// How far the corners of an image stand out above the map's heights on average, in footprints of a pixel, 0 or more:
        /// crests catch the eye, hollows do not.
        standing_out: zero_or_more,
        /// 1σ of that, common to all corners of an image, 0 or more.
        standing_out_sigma: zero_or_more,
        /// What an image shows otherwise than the map stays wrong in the same way until the scale has changed by this, as a
        /// natural logarithm, 0 or more: so many images as it takes to change the scale so much count as one.
        shared_ln_scale: zero_or_more,
    }
}

/// Every constant, by the wing that uses it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NoiseModel<T = f64> {
    /// Corners.
    pub corner: CornerNoise<T>,
    /// Patches.
    pub patch: PatchNoise<T>,
    /// Rotations of pairs.
    pub pair: PairNoise<T>,
    /// Rotations of a body.
    pub body: BodyNoise<T>,
    /// The designated point.
    pub designated: DesignatedNoise<T>,
    /// A map's points.
    pub map: MapNoise<T>,
}

impl PairNoise {
    /// Expected variance of the coefficients over the noise's, `view` being the squared translation over the distance.
    pub fn share(&self, view: f64) -> f64 {
        self.correlated_error_share * (1.0 + self.growth_by_view * view / (1.0 + view / self.far_view))
    }
}

impl<T> NoiseModel<T> {
    /// Every constant with its key, such as `patch.floor_sigma_px`.
    pub fn entries(&self) -> Vec<(&'static str, &T)> {
        let mut all = self.corner.entries();
        all.extend(self.patch.entries());
        all.extend(self.pair.entries());
        all.extend(self.body.entries());
        all.extend(self.designated.entries());
        all.extend(self.map.entries());
        all
    }

    /// The same constants in another form.
    pub fn map<U>(&self, of: impl Fn(&T) -> U) -> NoiseModel<U> {
        NoiseModel {
            corner: self.corner.map(&of),
            patch: self.patch.map(&of),
            pair: self.pair.map(&of),
            body: self.body.map(&of),
            designated: self.designated.map(&of),
            map: self.map.map(&of),
        }
    }
}

impl NoiseModel {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        self.corner.validate().map_err(|e| e.under("corner"))?;
        self.patch.validate().map_err(|e| e.under("patch"))?;
        self.pair.validate().map_err(|e| e.under("pair"))?;
        self.body.validate().map_err(|e| e.under("body"))?;
        self.designated.validate().map_err(|e| e.under("designated"))?;
        self.map.validate().map_err(|e| e.under("map"))
    }
}
