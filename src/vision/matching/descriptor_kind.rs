//! The list of all descriptors.

use super::descriptor::Descriptor;
use super::orb::Orb;
use super::sift::Sift;
use crate::vision::registry::registry;

registry! {
    /// What describes the neighbourhood of a feature.
    DescriptorKind of Descriptor:
    Orb "orb" = Orb, "256 comparisons of grey levels (Rublee et al. 2011): quick.";
    Sift "sift" = Sift, "128 sums of gradients (Lowe 2004): slower; finds more where light, scale or view change.";
}
