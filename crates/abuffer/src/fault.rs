//! Faults that [`well_formed`](crate::well_formed) may find in a built A-buffer.

/// Fault in a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// Link that points to no node.
    #[error("cell {cell}, bucket {bucket}: link {link} points to no node")]
    Dangling {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Link that points to no node.
        link: u32,
    },
    /// Link of a conservative list that points to no node, or leads in a circle.
    #[error("cell {cell}: link {link} of the conservative list points to no node, or leads in a circle")]
    Conservative {
        /// Index of the cell.
        cell: usize,
        /// Link at fault.
        link: u32,
    },
    /// Node of a divided conservative list that is not in its slice.
    #[error("cell {cell}: node {link} of the conservative list is not in its slice")]
    Slice {
        /// Index of the cell.
        cell: usize,
        /// Link of the node.
        link: u32,
    },
    /// Node that is in no list, or in more than one.
    #[error("{stored} nodes were allocated and {linked} are in lists")]
    Count {
        /// Number of nodes that the build allocated.
        stored: usize,
        /// Number of nodes found in lists.
        linked: usize,
    },
    /// Forward and backward links that disagree.
    #[error("cell {cell}, bucket {bucket}: the backward link of node {link} is {prev}, expected {expected}")]
    Backward {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Link that points to the node.
        link: u32,
        /// Backward link, as stored.
        prev: u32,
        /// Backward link, as expected.
        expected: u32,
    },
    /// Contiguous list that does not begin where the one before it ends.
    #[error("cell {cell}: the list begins at place {first}, expected {expected}")]
    Place {
        /// Index of the cell.
        cell: usize,
        /// First place, as stored.
        first: u32,
        /// First place, as expected.
        expected: usize,
    },
    /// Page that is in two lists, or whose number of used slots differs from the count in the word that leads
    /// to it.
    #[error(
        "cell {cell}, bucket {bucket}: page {page} is in two lists, or its used slots are not those counted"
    )]
    Page {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Number of the page.
        page: usize,
    },
    /// Contiguous node that refers to a payload that does not exist or belongs to another node.
    #[error("cell {cell}: node {link} refers to the payload {place}, which does not exist or is another's")]
    Payload {
        /// Index of the cell.
        cell: usize,
        /// Link that points to the node.
        link: u32,
        /// Place of the payload, as stored.
        place: u32,
    },
    /// Tail that is not the last node.
    #[error("cell {cell}, bucket {bucket}: the tail is {tail}, the last node is {last}")]
    Tail {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Tail, as stored.
        tail: u32,
        /// Link that points to the last node.
        last: u32,
    },
    /// Sorted list that is not in order.
    #[error("cell {cell}, bucket {bucket}: node {link} is out of order")]
    Order {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Link that points to the node out of order.
        link: u32,
    },
    /// Depth that lies outside of the cell's bounds or is not a positive number.
    #[error("cell {cell}, bucket {bucket}: depth {z} of node {link} is outside of [{z_min}, {z_max}]")]
    Depth {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Link that points to the node.
        link: u32,
        /// The depth, as text: it may be NaN.
        z: String,
        /// Smallest depth of the cell.
        z_min: String,
        /// Largest depth of the cell.
        z_max: String,
    },
}
